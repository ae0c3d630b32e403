# A vehicle that touched once does so as long as it is near.
# file: sim/gap/2_predict/bumps.c
# test: gap_leaves_out_a_rest
s/- touched_s) < SURE_S/- touched_s) < HUGE_VAL/
