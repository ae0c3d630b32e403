# What a right form with other numbers leaves is taken to lie in one line of the spectrum.
# file: sim/gap/5_infer/unknown.c
# test: gap_measures_a_misfit
s/sqrt(c->spreads > 1 ? c->spreads : 1)/1.0/
