# Another torque is withdrawn where the log misses commands, and an inertia told for it.
# file: sim/gap/5_infer/both_ways.c
# test: torque_that_is_another
s/return axis == 2 ? (scaled_t)/return axis > 2 ? (scaled_t)/
