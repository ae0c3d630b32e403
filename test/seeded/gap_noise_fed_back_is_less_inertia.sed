# Noise that is fed back is taken for an inertia that is smaller.
# file: sim/gap/5_infer/both_ways.c
# test: both_say
s/hypot(stderr_, unlike(b))/(unlike(b) < 2.0 ? stderr_ : 0.0)/
