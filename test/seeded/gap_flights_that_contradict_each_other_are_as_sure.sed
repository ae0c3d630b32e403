# Flights that contradict each other tell what they have in common as well as others.
# file: sim/gap/5_infer/score_estimate.c
# test: gap_errors_grow
s/fmax(from_flights \/ own, 1\.0)/fmax(0.0 * from_flights \/ own, 1.0)/
