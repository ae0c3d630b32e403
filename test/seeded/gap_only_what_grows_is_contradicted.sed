# A name stays of which held-out rows have nothing, where it is too small to grow their rms.
# file: sim/gap/7_verify/verify.c
# test: gap_withdraws_a_name_of_which
s/s->has < 0.5 \* s->adds/s->has < -1e9 * s->adds/
