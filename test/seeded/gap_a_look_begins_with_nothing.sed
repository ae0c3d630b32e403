# A look with nominal flights forgets what the one before it found.
# file: sim/gap/5_infer/select.c
# test: where_the_first_look_ended
s/r->strict = begin_with(t, before);/r->strict = begin_with(t, before ? NULL : before);/
