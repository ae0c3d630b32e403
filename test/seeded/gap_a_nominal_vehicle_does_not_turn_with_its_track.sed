# Nominal pilots hold their rates at 0, however the log turned.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: gap_nominal_flights_turn_as_much
s/const bool turns = w->unread \&\& f->g->has_rates;/const bool turns = false;/
