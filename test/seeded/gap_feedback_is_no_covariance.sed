# What nominal flights find does not widen what is known.
# file: sim/gap/5_infer/information.c
# test: gap_information_holds
s/p->low\[k \* flights + f\] = g\[k\]/p->low[k * flights + f] = 0.0 * g[k]/
