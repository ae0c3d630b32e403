# Stock INDI, fault 7: the acceleration of a trajectory is dropped.
# file: src/firmware/units.c
# test: app_
s/to->acc_w_mps2 = V3_OF(sp->acceleration);/to->acc_w_mps2 = (v3_t){0.0f, 0.0f, 0.0f};/
