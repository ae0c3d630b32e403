# What every half-flight shows alike is taken for ups and downs.
# file: sim/gap/5_infer/limits.h
# test: gap_score_is_not_sure
s/^#define SELECT_SURE 0\.9/#define SELECT_SURE 3.0/
