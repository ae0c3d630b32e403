# A look with nominal flights forgets what the one before it found.
# file: sim/gap/5_infer/select.c
# test: gap_looks_again_from_where
s/r->strict = begin_with(t, before);/r->strict = begin_with(t, before ? NULL : before);/
