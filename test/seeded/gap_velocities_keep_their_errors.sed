# Velocities stay as they are logged, errors of a moment and all: of flapping in a hover a twentieth is found.
# file: sim/gap/2_predict/smooth.c
# test: gap_takes_as_much_of_a_moment_out_of_velocities
s/v\[axis\] += g->of/v[axis] += 0.0 * g->of/
