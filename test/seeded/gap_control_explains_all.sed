# An inertia that explains far more than control of a disturbance could has to wait for nominal flights, which are shaken by it.
# file: sim/gap/5_infer/beyond_control.c
# test: gap_score_lets_in
s/^#define CONTROL_PEAK 2.0/#define CONTROL_PEAK 20.0/
