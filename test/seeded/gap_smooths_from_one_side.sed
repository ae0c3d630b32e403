# A place is the mean of those before alone: a velocity with a constant error moves it.
# file: sim/gap/2_predict/smooth.c
# test: gap_smooths_by_velocities
s/for (int i = j - side; i <= j + side; i++) sum = d3_add(sum, off\[i\]);/for (int i = j - 2 * side; i <= j; i++) sum = d3_add(sum, off[i < 0 ? 0 : i]);/
