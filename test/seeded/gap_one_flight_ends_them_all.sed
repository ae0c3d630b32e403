# A track that cannot be flown ends all nominal flights.
# file: sim/gap/3_feedback/nominal.c
# test: gap_nominal_flight_that
s/^    if (status != DONE) continue;/    if (status != DONE) return status;/
