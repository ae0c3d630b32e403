# An accelerometer that filters is taken for as calm as two samples of it are alike.
# file: sim/gap/5_infer/loop_fit.c
# test: gap_takes_the_age_of_a_range_sample_for_no_effect
s/loop->acc_mps2\[k\] = gusts\.white\[k\];/(void)0;/
