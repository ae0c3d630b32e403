# How strongly commands tilt the vehicle is told whatever control makes of noise.
# file: sim/gap/5_infer/round.c
# test: gap_names_mass_beside
s/limits_nominal(r->nominal->n) \* rms\[k\] < c->typical\[k\]/limits_nominal(r->nominal->n) * rms[k] < 100.0 * c->typical[k]/
