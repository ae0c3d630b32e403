# What acts for a time is looked for where it does not.
# file: sim/gap/5_infer/for_a_time.c
# test: gap_says_as_which_effect
s/squares\[1\] \* rows\[0\] > squares\[0\]/squares[1] * rows[0] < squares[0]/
