# A right form leaves no misfit.
# file: sim/gap/4_candidates/candidates.h
# test: gap_information_widens
s/^#define CANDIDATES_MISFIT 0\.02/#define CANDIDATES_MISFIT 0.0001/
