# What acts in one half of the flights only is named.
# file: sim/gap/5_infer/local.c
# test: gap_knows_a_name_that_acts
s/^#define CLEAR        40\.0/#define CLEAR 1e9/
