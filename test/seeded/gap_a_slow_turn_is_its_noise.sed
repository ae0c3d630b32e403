# Where the vehicle hardly turns, the windows that count are those in which the attitude's noise adds to it.
# file: sim/gap/1_read/check.c
# test: gap_refuses_no_hover_for
s/(b - error > SLOPE_MAX && s->all_mg > SLOPE_MAX \* s->all_gg)/(b - error > SLOPE_MAX)/
