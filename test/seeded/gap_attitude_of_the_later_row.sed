# A point has the attitude of its last row, and everything else of its middle.
# file: sim/gap/2_predict/grid.c
# test: gap_points_have_attitude_and_place
s/mean_attitude(f, from, n)/mean_attitude(f, from + n - 1, 1)/
