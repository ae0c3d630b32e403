# Where the acceleration is made of velocities, what these have beyond two samples' difference is left out.
# file: sim/gap/5_infer/loop_fit.c
# test: gap_nominal_flights_shake
s/hypot(loop->vel_mps\[k\], gusts\.velocity_mps\[k\])/loop->vel_mps[k]/
