# However much more a delay says than control makes, it is control's.
# file: sim/gap/5_infer/own_work.c
# test: gap_takes_control_that
s/(log - mean) \/ bound : HUGE_VAL/(log - mean) \/ bound * 1e-6 : HUGE_VAL/
