# What control makes of a draught is named.
# file: sim/gap/5_infer/own_work.c
# test: gap_takes_control_that
s/\*usual = status == DONE && is_usual/*usual = status != DONE \&\& is_usual/
