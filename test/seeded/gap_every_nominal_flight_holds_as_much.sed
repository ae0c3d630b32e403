# A nominal flight that hardly comes where an effect acts counts as much as one that does.
# file: sim/gap/5_infer/score.c
# test: gap_score_counts_a_nominal_flight
s/const double weight = holds ? holds\[i\] : 1.0;/const double weight = holds ? 1.0 : 1.0;/
