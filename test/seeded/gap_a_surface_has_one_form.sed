# A surface is looked for as an exponential alone, and the tail of any other form becomes an effect.
# file: sim/gap/4_candidates/candidates.c
# test: gap_finds_a_surface_in_the_form
s/for (int i = 0; !own && i < curve_count; i++)/for (int i = 0; !own \&\& i < 0; i++)/
