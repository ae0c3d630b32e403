# What feedback alone makes as much of is named.
# file: sim/gap/5_infer/score.c
# test: gap_score_lets_in
s/> limits_nominal(/> 0.1 * limits_nominal(/
