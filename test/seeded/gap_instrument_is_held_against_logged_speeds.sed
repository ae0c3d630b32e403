# A name is held against least squares of other products than it was found in.
# file: sim/gap/5_infer/confirm.c
# test: gap_s_instrument_differs
s/t->plain.total, t->plain.block}/NULL, NULL}/
