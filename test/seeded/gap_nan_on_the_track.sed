# One sample that is not there reaches the pilot of a nominal flight.
# file: sim/gap/3_feedback/nominal_fly.c
# test: gap_nominal_flight_is_not
s/^  bridge(point, from, to);/  if (from > to) bridge(point, from, to);/
