# Moments that flights differ by are disturbances of each.
# file: sim/gap/5_infer/loop_fit.c
# test: gap_nominal_flights_do_not_shake
s/if (s->n_grid > 1) rows_center/if (s->n_grid > 100) rows_center/
