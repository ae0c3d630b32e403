# Lessons over the ground before the rotors have carried for rls.after.
# file: src/flight.c
# test: flight_learns
s/ \&\& o->carrying_s >= o->param\.learn_after_s//
