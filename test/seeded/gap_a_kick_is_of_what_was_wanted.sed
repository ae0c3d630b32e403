# A pilot whose lead is on the error kicks the other way.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: gap_a_pilot_kicks
s|d3_scale(-1.0, d3_add(off, wanted_radps))|d3_sub(wanted_radps, off)|
