# Of flights that are flown elsewhere it is told that something lies there.
# file: sim/gap/5_infer/unknown.c
# test: gap_tells_flights
s/if (along == BY_FLIGHT) return -1;/if (along == BY_FLIGHT) return 2;/
