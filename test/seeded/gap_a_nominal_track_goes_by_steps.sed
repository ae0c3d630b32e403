# Nominal pilots are told where to be point by point.
# file: sim/gap/3_feedback/nominal_fly.c
# test: gap_nominal_pilots_are_told_their_track
s/pilot_take_track(f, (i \* inner + k) \/ (double)(per_point \* inner));/pilot_take_track(f, 0.0);/
