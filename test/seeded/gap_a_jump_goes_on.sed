# What jumps once in a log is taken for a disturbance that goes on.
# file: sim/gap/5_infer/loop_fit.c
# test: gap_shakes_nominal_flights_by_no_jump
s/left->of\[ch\] = steadiness(&s->smooth, l->r\[ch\]) \* /left->of[ch] = fmax(1.0, steadiness(\&s->smooth, l->r[ch])) * /
