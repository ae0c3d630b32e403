# Of eight points at a time a candidate that moves the centre of mass is looked at with the rotors where they were without it.
# file: sim/gap/2_predict/eight.c
# test: gap_replay
s/const bool moved = !same_places/const bool moved = path->n_rigid < 0 \&\& !same_places/
