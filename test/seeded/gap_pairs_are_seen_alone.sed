# What two effects take one by one counts as what they take together.
# file: sim/gap/5_infer/pairs.c
# test: gap_finds_two
s/ - takes\[i\] - takes\[k\]//
