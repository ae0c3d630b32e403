# 32767 mm is taken for a distance.
# file: src/ceiling.c
# test: ceiling
s/range_m > 0\.0f && range_m <= CEILING_RANGE_MAX_M/range_m > 0.0f/
