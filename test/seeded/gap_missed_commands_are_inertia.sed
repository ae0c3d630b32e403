# What commands do that a log misses is taken for inertia.
# file: sim/gap/5_infer/both_ways.c
# test: both_say
s/reverse = i->yp \/ i->yy - 1.0/reverse = forward/
