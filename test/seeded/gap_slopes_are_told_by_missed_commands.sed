# What a log misses of the commands is not a slope of the thrust.
# file: sim/gap/4_candidates/columns.c
# test: gap_leaves_a_scale_of_the_turning_out
s/if (!grid_misses_commands(/if (f >= 0 || !grid_misses_commands(/
