# What commands do that a log misses is taken for inertia.
# file: sim/gap/5_infer/both_ways.c
# test: both_say
s/nearest = k > 0.0 ? reverse : forward/nearest = forward/
