# Stock INDI, fault 3: a velocity in the body's frame is taken as one in the world's.
# file: src/flight.c
# test: flight_
s/if (sp->vel_in_body) {/if (false) {/
