# A kick about z takes all that the motors have.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: is_told_its_heading
s/if (w->kicks) turn.z = within_yaw/if (w->kicks \&\& lead < 0.0) turn.z = within_yaw/
