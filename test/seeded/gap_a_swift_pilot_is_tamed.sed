# A pilot whose gains are believed is cut when it flies.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: gap_tames_a_pilot_to_what
s/larger(w->swift, 1.0) \*/1.0 */
