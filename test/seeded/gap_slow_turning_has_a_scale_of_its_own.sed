# An inertia stands though slow turning says another number than fast.
# file: sim/gap/5_infer/both_ways.c
# test: gap_takes_for_no_inertia
s/SCORE_ERRORS \* hypot(fast.stderr_, slow.stderr_) + /HUGE_VAL + /
