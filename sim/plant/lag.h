// lag.h - how a rotor follows its command: first order in its speed, as motors do, or in its thrust, as
// controllers of small vehicles take it. About a working point both are the same. Of a lag in speed a part
// may go with the square of it, as the air's drag slows a rotor down:
//
//   dOm/dt = (u - Om) (1 - q + q (u + Om) / (2 Om_0)) / tau,   Om_0: where tau is told, in the hover
//
// which is a (u - Om) + b (u^2 - Om^2) of a = (1 - q) / tau and b = q / (2 Om_0 tau).
#ifndef SIM_PLANT_LAG_H
#define SIM_PLANT_LAG_H

#include "base/larger.h"
#include <math.h>
#include <stdbool.h>

#define LAG_LEAST_S 1e-3 // a shorter one is none: the thrust is what is commanded

typedef struct {
  double up_s, down_s;           // >= 0, while it rises and while it falls
  bool in_speed;                 // of the rotor; else in thrust
  double up_square, down_square; // 0 to 1: q, of a lag in speed
  double steady_N;               // > 0 where there is a q: thrust of a rotor at Om_0
} lag_t;

static inline bool lag_is_none(const lag_t *lag) {
  return lag->up_s < LAG_LEAST_S;
}

static inline bool lag_is_squared(const lag_t *lag) {
  return !lag_is_none(lag) && lag->in_speed && (lag->up_square > 0.0 || lag->down_square > 0.0);
}

// What follows: the thrust, or the root of it, which is a speed.
static inline double lag_follows(const lag_t *lag, double thrust_N) {
  return lag->in_speed ? sqrt(larger(thrust_N, 0.0)) : thrust_N;
}

#endif
