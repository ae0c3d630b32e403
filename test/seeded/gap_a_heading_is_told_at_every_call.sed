# A pilot that kicks is told its heading at every call.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: is_told_its_heading
s/stepped_rad = looks ? w->outer_s/stepped_rad = looks || true ? w->outer_s/
