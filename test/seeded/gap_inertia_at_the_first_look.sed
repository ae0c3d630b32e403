# What control makes of a disturbance is named without nominal flights.
# file: sim/gap/5_infer/score.c
# test: gap_score_lets_in
s/!beyond_control(j, choice, v)) return false;/!beyond_control(j, choice, v)) largest = 0.0;/
