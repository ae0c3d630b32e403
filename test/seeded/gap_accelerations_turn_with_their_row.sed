# An acceleration in the world's axes is turned by the attitude of its row, however late that is.
# file: sim/gap/1_read/read.c
# test: gap_turns_accelerations_by_the_attitude
/raw_to_world(raw);/d
