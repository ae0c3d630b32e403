# What feedback alone makes as much of is named.
# file: sim/gap/5_infer/score.h
# test: gap_score_lets_in
s/^#define SELECT_NOMINAL 3\.0/#define SELECT_NOMINAL 0.3/
