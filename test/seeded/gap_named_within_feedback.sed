# What feedback alone makes as much of is named.
# file: sim/gap/5_infer/score.c
# test: gap_score_lets_in
s/v->over_nominal > 1.0;/v->over_nominal > 0.0;/
