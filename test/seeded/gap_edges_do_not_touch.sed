# A moment that no air makes is no bump.
# file: sim/gap/2_predict/bumps.c
# test: gap_leaves_out_points_at_which_something_solid_pushes
s/^#define EDGE_SHARE 0.1/#define EDGE_SHARE 9.0/
