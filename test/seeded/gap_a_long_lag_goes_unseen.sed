# A lag that no straight line finds is not tried.
# file: sim/gap/5_infer/timing.c
# test: gap_finds_a_long
s/best = none - by_chance/best = none - 1e9 * by_chance/
