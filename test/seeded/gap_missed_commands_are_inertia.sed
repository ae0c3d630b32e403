# What commands do that a log misses is taken for inertia.
# file: sim/gap/5_infer/both_ways.c
# test: both_say
s/return b->yp \/ b->yy - 1.0/return b->pp \/ b->yp - 1.0/
