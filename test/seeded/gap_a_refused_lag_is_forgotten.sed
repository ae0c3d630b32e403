# What fits better in a name's place, and was refused for what feedback makes of it, is no rival.
# file: sim/gap/5_infer/family.c
# test: told_it_beside_a_delay
s/if (fits_better(r, own, with)) return true;/if (!r \&\& fits_better(r, own, with)) return true;/
