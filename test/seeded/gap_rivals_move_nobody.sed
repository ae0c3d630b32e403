# A rival of one name leaves the errors of the others as they are.
# file: sim/gap/5_infer/family.c
# test: gap_is_less_sure_of_a_number
s/fmax(other->by_rivals\[k\]/fmin(other->by_rivals[k]/
