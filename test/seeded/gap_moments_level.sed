# In a short log a moment that begins is a disturbance.
# file: sim/gap/3_feedback/stirs.c
# test: gap_takes_no_moment_that_begins
s/^#define LEVEL_CHANGES 4/#define LEVEL_CHANGES 2/
