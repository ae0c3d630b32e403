// over.c - when a flight is over.
#include "flight/over.h"

#include <math.h>

flight_over_t flight_over(const plan_t *plan, double tick_s, long tick, const body_t *body,
                          const double motor_N[PILOT_MOTORS]) {
  bool finite = !body->broken;
  for (int i = 0; i < PILOT_MOTORS; i++) finite = finite && isfinite(motor_N[i]);
  if (!finite) return FLIGHT_NOT_FINITE;
  // Beyond the tick that is nearest to the end, without the call of lround().
  return plan->end_s / tick_s < (double)tick - 0.5 ? FLIGHT_TIME_UP : FLIGHT_FLIES;
}
