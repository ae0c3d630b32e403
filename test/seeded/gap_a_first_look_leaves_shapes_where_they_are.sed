# What is tried is the grid of shapes, and their misfit a name.
# file: sim/gap/5_infer/select.c
# test: a_sag_between_the_voltages
s/if (!t->candidates\[candidate\].n_shape) return false;/if (use->fx) return false;/
