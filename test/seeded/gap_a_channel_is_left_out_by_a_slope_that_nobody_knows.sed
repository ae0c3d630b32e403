# A channel is left out by a slope that noise makes.
# file: sim/gap/2_predict/excluded.c
# test: gap_says_that_the_spins_have_the_other_sign
s/slope + 2\.0 \* error/slope + 0.0 * error/
