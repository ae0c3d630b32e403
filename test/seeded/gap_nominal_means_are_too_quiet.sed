# A step of a nominal flight has the noise of a row that is a mean over many.
# file: sim/gap/3_feedback/nominal_fly.c
# test: gap_nominal_flights_shake
s/? sqrt(f\.steps) : 1\.0/? 1.0 : 1.0/
