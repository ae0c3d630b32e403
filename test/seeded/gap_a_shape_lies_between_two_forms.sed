# The decay of an exponential and the radius of an inverse square are taken for values of one number.
# file: sim/gap/5_infer/bend.c
# test: gap_finds_no_shape_between_two_forms
s/ a->form == b->form &&$//
