# Fitted flights that differ as much as nominal ones let a held-out one have something of its own.
# file: sim/gap/5_infer/unknown.c
# test: gap_says_what_flights
s/each\[ch\]\.statistic > limits_nominal(n) \*/each[ch].statistic > 0.0 * limits_nominal(n) */
