# A flipped bit makes a filter's state no number, and nothing looks there: it gives nothing else for ever.
# file: src/flight.c
# test: flight_flies_on
s/if (!att_indi_good(&f->att)) {/if (false) {/
