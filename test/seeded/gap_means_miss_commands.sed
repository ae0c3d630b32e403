# Rows that are means hold every command.
# file: sim/gap/4_candidates/columns.c
# test: gap_leaves_a_scale_of_the_turning_out
s/ \&\& !s->grid\[f\].flight->rows_are_means/ \&\& s->n_grid < 99/
