# A lag that no straight line finds is not tried.
# file: sim/gap/5_infer/timing.c
# test: gap_finds_a_long
s/^#define BETTER 50\.0/#define BETTER 1e9/
