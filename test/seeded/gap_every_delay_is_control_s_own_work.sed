# However much more a delay says than control makes, it is control's.
# file: sim/gap/5_infer/own_work.c
# test: gap_takes_control_that
s/\*usual = status == DONE && is_usual/*usual = status == DONE || is_usual/
