# Where its place is not known it is clear of everything.
# file: sim/gap/2_predict/bumps.c
# test: gap_leaves_out_a_landing
s/if (p->clear_m >= SURE_M) touched_s/if (!(p->clear_m < SURE_M)) touched_s/
