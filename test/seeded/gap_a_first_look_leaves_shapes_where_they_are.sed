# What is tried after a first look is the grid of shapes, and their misfit a name.
# file: sim/gap/diagnose.c
# test: a_sag_between_the_voltages
s/if (first->shape\[i\] > 0.0)/if (first->shape[i] > 1e9)/
