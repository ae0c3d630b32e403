# A pilot that kicks is told its heading at every call.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: is_told_its_heading
s#kicks && looks ? point_nose#kicks && (looks || kicks) ? point_nose#
