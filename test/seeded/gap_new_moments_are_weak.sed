# Moments that are new at each step turn nominal flights too little.
# file: sim/gap/3_feedback/nominal_fly.c
# test: gap_nominal_flights_are_turned
s/^#define ROWS_S 0\.085/#define ROWS_S 0.05/
