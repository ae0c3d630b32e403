# What changes for half a flight is taken for shorter.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_takes_no_moment_that_begins
s/^#define STANDS_S     60.0/#define STANDS_S 30.0/
