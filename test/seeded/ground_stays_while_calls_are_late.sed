# What the ground gave before calls were missed is flown by.
# file: src/watch.c
# test: flight_forgets
s/if (ms != 1) lose_ground/if (ms == 0) lose_ground/
