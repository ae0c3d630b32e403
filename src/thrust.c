// thrust.c - motor lag and thrust bookkeeping.
#include "flight/thrust.h"

#include "flight/expneg.h"
#include "flight/v3.h"

void thrust_reset(thrust_t *s, float thrust_N) {
  lpf2_reset(&s->lpf, thrust_N);
  s->model_N = thrust_N;
  s->since_limit_s = THRUST_LIMIT_MEMORY_S;
}

float thrust_lag_share(float period_s, float tau_s) {
  return 1.0f - expneg(period_s / tau_s);
}

float thrust_step(thrust_t *s, const lpf2_coef_t *c, float lag_share, float period_s, float applied_N,
                  bool at_limit) {
  const float filtered_N = lpf2_step(&s->lpf, c, applied_N);
  s->model_N += lag_share * (filtered_N - s->model_N);
  const float later_s = s->since_limit_s + period_s;
  const bool remembers = s->since_limit_s < THRUST_LIMIT_MEMORY_S;
  s->since_limit_s = EITHER(at_limit, 0.0f, EITHER(remembers, later_s, s->since_limit_s));
  return s->model_N;
}
