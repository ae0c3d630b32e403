# The disturbance of nominal flights is a third of the log's.
# file: sim/gap/5_infer/loop_fit.c
# test: gap_nominal_flights_shake
s/fmin(by, 1\.0) : 0\.0;/fmin(0.3 * by, 1.0) : 0.0;/
