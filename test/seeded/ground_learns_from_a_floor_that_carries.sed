# Lessons over the ground while a floor carries.
# file: src/flight.c
# test: flight_learns
s/ \&\& !outer_on_floor(o);/;/
