# A kick about z takes what the motors have, and they get their lead on top.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: is_told_its_heading
s/YAW_SHARE . (1.0 + lead)/YAW_SHARE \/ (1.0 + 0.0 * lead)/
