# Nominal pilots follow the smoothed places, which no pilot saw.
# file: sim/gap/3_feedback/nominal_fly.c
# test: gap_nominal_pilots_follow
s/point\[j\].pos_w_m = point\[j\].seen_w_m;/point[j].pos_w_m = point[j].pos_w_m;/
