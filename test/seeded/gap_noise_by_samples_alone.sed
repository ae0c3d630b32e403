# What an accelerometer that filters has between its samples shakes nobody.
# file: sim/gap/5_infer/loop_fit.c
# test: gap_names_nothing_that_control_makes
/memcpy(loop->quick_mps2, gusts/d
