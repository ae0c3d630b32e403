# What control makes of a disturbance is named without nominal flights.
# file: sim/gap/5_infer/score.c
# test: gap_score_lets_in
s/only_beside_nominal) return false;/only_beside_nominal) largest = 0.0;/
