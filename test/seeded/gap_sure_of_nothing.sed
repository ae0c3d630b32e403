# What every half-flight shows alike is taken for ups and downs.
# file: sim/gap/5_infer/score.c
# test: gap_score_is_not_sure
s/sum >= sqrt(squares)/sum >= 3.0 * sqrt(squares)/
