# Moments of a tenth of a second are taken for new at each step.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_takes_no_moment_that_begins
s/^#define TURN_LEAST_S 0.05/#define TURN_LEAST_S 0.1/
