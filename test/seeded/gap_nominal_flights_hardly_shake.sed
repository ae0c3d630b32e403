# The disturbance of nominal flights is a third of the log's.
# file: sim/gap/5_infer/loop_fit.c
# test: gap_nominal_flights_shake
s/memcpy(loop->force_mps2, gusts\.force_mps2, sizeof gusts\.force_mps2);/for (int k = 0; k < 3; k++) loop->force_mps2[k] = 0.3 * gusts.force_mps2[k];/
