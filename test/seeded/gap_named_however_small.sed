# A thousandth of what is typical is named.
# file: sim/gap/5_infer/limits.h
# test: gap_score_lets_in
s/^#define SELECT_LEAST 0\.12/#define SELECT_LEAST 0.001/
