# The error of a number counts a nominal flight that hardly comes there as much as one that does.
# file: sim/gap/5_infer/score.c
# test: gap_s_errors_count_a_nominal_flight
s/nominal_rms(j, choice, false, rms);/nominal_rms(j, choice, true, rms);/
