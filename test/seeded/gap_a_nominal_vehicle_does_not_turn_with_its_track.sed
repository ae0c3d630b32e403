# Nominal pilots hold their rates at 0, however the log turned.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: gap_nominal_flights_turn_as_much
s/const d3_t off = f->g->has_rates ? d3_sub(track->rate_b_radps, rate) : d3_scale(-1.0, rate);/const d3_t off = d3_scale(-1.0, rate);/
