# A right form leaves no misfit.
# file: sim/gap/5_infer/information.c
# test: gap_information_widens
s/^#define MISFIT        0\.02/#define MISFIT 0.0001/
