# Rows that are means hold every command.
# file: sim/gap/2_predict/grid.c
# test: gap_leaves_a_scale_of_the_turning_out
s/return grid_is_slow(g) \&\& !g->flight->rows_are_means/return grid_is_slow(g) \&\& g->flight/
