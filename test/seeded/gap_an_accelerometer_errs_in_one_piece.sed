# What an accelerometer errs by along z comes with what it errs by along x and y, and a mass against it.
# file: sim/effects/fx_accel_bias.c
# test: numbers_that_have_other_rivals
s/\.size_apart = 2/.size_apart = 0/
