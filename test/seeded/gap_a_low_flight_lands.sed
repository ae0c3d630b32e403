# Who touches the ground lands.
# file: sim/gap/2_predict/bumps.c
# test: gap_leaves_out_a_landing
s/(is_high(m, p) || j < first || j > last)/true/
