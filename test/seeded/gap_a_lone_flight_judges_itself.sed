# A lone flight is held out by its own numbers.
# file: sim/gap/diagnose.c
# test: gap_fits_all_of_a_lone
s/if (!held_apart(job))/if (held_apart(job))/
