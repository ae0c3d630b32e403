# No nominal pilot has its lead on the error of a rate.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_every_other_nominal_pilot
s/v.kicks = i % 4 == 1/v.kicks = i < 0/
