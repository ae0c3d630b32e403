# Which effect would do is asked of all flights together.
# file: sim/gap/5_infer/flights_differ.c
# test: gap_says_what_flights_differ_by
s/sums_in(t, t->whole, f), sums_in/sums_in(t, t->whole, d->n), sums_in/
