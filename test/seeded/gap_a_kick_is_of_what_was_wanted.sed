# A pilot whose lead is on the error kicks the other way.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: gap_a_pilot_kicks
s|led.x -= w->tilt_gain|led.x += w->tilt_gain|
