# What control makes of a disturbance is named without nominal flights.
# file: sim/gap/5_infer/beyond_control.c
# test: gap_score_lets_in
s/if (made > error) return false;/if (made > error) return true;/
