# What a log misses of the commands is not a slope of the thrust.
# file: sim/gap/4_candidates/columns.c
# test: gap_leaves_a_scale_of_the_turning_out
s/if (misses_commands(s)) leave_out/if (misses_commands(s) \&\& s->n_grid > 99) leave_out/
