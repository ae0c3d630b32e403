# Noise of each motor lasts as long as a draught.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_takes_no_moment_that_begins
s/^    w->turn_quick\[k\] = .*/    w->turn_quick[k] = 0.0 * lasting;/
