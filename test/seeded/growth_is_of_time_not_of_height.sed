# A ratio that grows with time, as in a gust, is taken for a ceiling's.
# file: src/judge_ceiling.c
# test: guard_t
s/fit_growth(&g->growth, shown - g->ratio_usual, dt \* g->vel_w_mps.z,/fit_growth(\&g->growth, shown - g->ratio_usual, 0.1f * dt,/
