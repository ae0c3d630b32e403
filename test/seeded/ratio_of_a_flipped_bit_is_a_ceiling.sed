# A reason of the guard that a flipped bit made stands until the next sample of the thrust.
# file: src/judge_ceiling.c
# test: flight_flies_on_with_any_bit
s/ \&\& g->ratio_ms >= GUARD_RATIO_LASTS_MS;/;/
