# A lead about z is limited as one about x.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_leads_a_nose
s/w->rate_gain_most . yaw_at_once(m) . w->rate_gain\[2\] - 1.0/w->rate_gain_most \/ w->rate_gain[2] - 1.0 + 0.0 * yaw_at_once(m)/
