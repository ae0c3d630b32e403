# What feedback takes away from a size counts as what it could make of it.
# file: sim/gap/5_infer/score.c
# test: gap_score_takes_no_bias
s/value\[i\] -= fmin(mean, 0.0);/value[i] -= 0.0 * fmin(mean, 0.0);/
