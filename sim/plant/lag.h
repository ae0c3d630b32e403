// lag.h - how a rotor follows its command: first order in its speed, as motors do, or in its thrust, as
// controllers of small vehicles assume. Near a working point both are the same. Part of a lag in speed may be
// quadratic, as the air's drag slows a rotor down:
//
//   dOm/dt = (u - Om) (1 - q + q (u + Om) / (2 Om_0)) / tau
//
// u: commanded speed; Om_0: speed in hover, at which tau is given. This equals a (u - Om) + b (u^2 - Om^2)
// with a = (1 - q) / tau and b = q / (2 Om_0 tau).
#ifndef SIM_PLANT_LAG_H
#define SIM_PLANT_LAG_H

#include "base/larger.h"
#include <math.h>
#include <stdbool.h>

#define LAG_LEAST_S 1e-3 // below this there is no lag: the thrust is what is commanded

typedef struct {
  double up_s, down_s;           // >= 0, while it rises and while it falls
  bool in_speed;                 // in the rotor's speed; else in its thrust
  double up_square, down_square; // q, 0 to 1, of a lag in speed
  double steady_N;               // a rotor's thrust at Om_0, > 0 where q > 0
} lag_t;

static inline bool lag_is_none(const lag_t *lag) {
  return lag->up_s < LAG_LEAST_S;
}

static inline bool lag_is_squared(const lag_t *lag) {
  return !lag_is_none(lag) && lag->in_speed && (lag->up_square > 0.0 || lag->down_square > 0.0);
}

// The quantity that lags: the thrust, or its square root, which is proportional to the speed.
static inline double lag_follows(const lag_t *lag, double thrust_N) {
  return lag->in_speed ? sqrt(larger(thrust_N, 0.0)) : thrust_N;
}

#endif
