# Flights that cannot be flown are left out in silence.
# file: sim/gap/5_infer/nominal_sums.c
# test: gap_counts_the_flights
/n->lost += /d
