# Places are taken as they are logged.
# file: sim/gap/2_predict/smooth.c
# test: gap_takes_errors_of_a_moment
s/int reach = (int)round(SMOOTH_S \/ g->period_s);/int reach = 0 * (int)round(SMOOTH_S \/ g->period_s);/
