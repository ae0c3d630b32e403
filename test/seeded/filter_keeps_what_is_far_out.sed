# A flipped bit makes 1e30 of a filter's state, which is a number: it comes back late, and flies meanwhile.
# file: src/sync.c
# test: flight_flies_on
s/fabsf(sum) <= STATE_MAX/fabsf(sum) <= FLT_MAX/
