# Seeds that lie within others are not seen to be there.
# file: sim/flight/summary.c
# test: summary_counts_no_flight_twice
s/s->seeds\[at\].from <= new.to ? -1 : at;/s->seeds[at].from == new.from ? -1 : at;/
