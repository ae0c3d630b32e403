# What lies beside a point that touches is air.
# file: sim/gap/2_predict/bumps.c
# test: gap_leaves_out_a_rest
s/- touched_s) < SURE_S/- touched_s) < 0.0/
