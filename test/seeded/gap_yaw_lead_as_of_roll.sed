# A lead about z as large as about the other axes shakes a vehicle of heavy rotors.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_steers_no_more_about_z
s/ \/ (axis == 2 ? yaw_at_once(m) : 1\.0)//
