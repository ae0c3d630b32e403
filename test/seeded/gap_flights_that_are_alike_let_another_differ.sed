# Fitted flights that differ as much as nominal ones let a held-out one have something of its own.
# file: sim/gap/5_infer/unknown.c
# test: gap_says_what_flights
s/cell\[ch\]\.statistic > limits_nominal(n) \* usual(nominal, n, -1/cell[ch].statistic > 0.0 * usual(nominal, n, -1/
