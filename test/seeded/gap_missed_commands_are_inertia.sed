# What commands do that a log misses is taken for inertia.
# file: sim/gap/5_infer/both_ways.c
# test: both_say
s/const double least = .*/const double least = k;/
