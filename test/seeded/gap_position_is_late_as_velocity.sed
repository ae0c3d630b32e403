# The position is moved as the velocity is, however late it is.
# file: sim/gap/1_read/read.c
# test: streams_that_are_late
s/if (f->velocity_late_s > 0.0)/if (f->velocity_late_s > 1e9)/
