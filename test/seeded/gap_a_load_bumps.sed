# What pushes a vehicle all the time is a bump near a surface, and a ceiling effect is left out with it.
# file: sim/gap/2_predict/bumps.c
# test: gap_leaves_out_points_at_which_something_solid_pushes
s/of\[k\]\[j\] - usual\[k\]/of[k][j] - 0.0 * usual[k]/
