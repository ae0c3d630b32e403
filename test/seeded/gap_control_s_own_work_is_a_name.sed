# What control makes of a draught is named.
# file: sim/gap/5_infer/own_work.c
# test: gap_takes_control_that
s/own\[k\] = each\[k\] < 1\.0/own[k] = each[k] < 0.0/
