# Fitted flights that differ as much as nominal ones let a held-out one have something of its own.
# file: sim/gap/5_infer/unknown.c
# test: gap_says_what_flights
s/const double chance = furthest \*/const double chance = 0.0 * furthest */
