# A stretch is held against numbers that were fitted to it.
# file: sim/gap/5_infer/by_turns.c
# test: gap_turns_do_not_know
s/turn\[block\] == held_out &&/turn[block] == held_out + TURNS \&\&/
