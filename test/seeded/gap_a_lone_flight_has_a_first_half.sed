# A lone flight's halves are its first and its second.
# file: sim/gap/2_predict/set.c
# test: gap_halves_of_a_lone
s/return s->n_grid == 1 ?/return s->n_grid == 0 ?/
