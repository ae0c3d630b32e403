// thrust.h - the thrust that the motors give now, in newton, synchronous with the filtered acceleration.
//
//   F(k) = filter(Tc(k-1)),  T(k) = T(k-1) + (1 - exp(-dt/tau)) (F(k) - T(k-1))
//
// Tc(k-1) is the thrust that was applied during the last period. The first-order lag is exact for an input
// that is held over the period; the filter is the one that the acceleration passes (thesis section 3.2). One
// tick more or less of delay here visibly changes the closed loop.
#ifndef FLIGHT_THRUST_H
#define FLIGHT_THRUST_H

#include "flight/lpf2.h"
#include <stdbool.h>

typedef struct {
  lpf2_t lpf;
  float model_N;       // T(k)
  float since_limit_s; // time since the command was last at a limit
} thrust_t;

#define THRUST_LIMIT_MEMORY_S 10.0f // since_limit_s stops here

// Sets all signals to thrust_N, with no limit reached in the remembered time.
void thrust_reset(thrust_t *s, float thrust_N);

// Returns the sum of the state, as lpf2_sum.
static inline float thrust_sum(const thrust_t *s) {
  return lpf2_sum(&s->lpf) + s->model_N + s->since_limit_s;
}

// Returns the share of a step that a first-order lag of tau_s (> 0) follows within period_s.
float thrust_lag_share(float period_s, float tau_s);

// Runs one period in which applied_N (finite) was commanded; at_limit: that was a limit. Returns T(k).
float thrust_step(thrust_t *s, const lpf2_coef_t *c, float lag_share, float period_s, float applied_N,
                  bool at_limit);

#endif
