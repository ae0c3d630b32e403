# Of another torque that a slow log shows an inertia is no rival.
# file: sim/gap/5_infer/family.c
# test: beside_another_torque
s/|| missed_commands_hide(r, own, other)/|| (own < 0 \&\& missed_commands_hide(r, own, other))/
