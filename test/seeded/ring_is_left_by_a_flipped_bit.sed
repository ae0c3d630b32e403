# The newest climb's place is taken as it is: a flipped bit of it reads and writes foreign memory.
# file: src/ceiling.c
# test: flight_flies_on
s/return (s->newest - ticks) % CEILING_HISTORY;/return (s->newest - ticks) % (1u << 24);/
