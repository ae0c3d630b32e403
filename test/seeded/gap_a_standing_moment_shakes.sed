# A moment that changes once in a flight is taken for one of 3 s.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_takes_a_moment_that_changes_once
s/^#define STANDS_S 60.0/#define STANDS_S 3.0/
