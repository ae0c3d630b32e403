# A bump at the ceiling is taken for what the air does.
# file: sim/gap/2_predict/bumps.c
# test: gap_leaves_out_points_at_which_something_solid_pushes
s/^#define LIFT_SHARE 0.5/#define LIFT_SHARE 5.0/
