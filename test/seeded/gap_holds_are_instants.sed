# A difference of two points sees the model's thrust at three instants alone.
# file: sim/gap/2_predict/holds.c
# test: gap_turning_is_that_of_commands_that_hold
s/return !g->by_speeds \&\& /return g->by_speeds \&\& /
