# Mass and thrust scale come in together, though only one is told.
# file: sim/gap/5_infer/pairs.c
# test: gap_finds_two
s/ && round_fits(r, &one, k)//
