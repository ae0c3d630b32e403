# Two effects that hide each other are not looked for.
# file: sim/gap/5_infer/select.c
# test: a_sag_is_told_beside
s/^    \*added = pair_passes(t, &pairs.pair\[i\]);/    *added = pair_passes(t, \&pairs.pair[i]) \&\& i < 0;/
