// over.h - when a flight is over.
#ifndef SIM_FLIGHT_OVER_H
#define SIM_FLIGHT_OVER_H

#include "flight/plan.h"

typedef enum {
  FLIGHT_FLIES,
  FLIGHT_TIME_UP,    // the plan's end_s has passed
  FLIGHT_NOT_FINITE, // the body is broken, or a motor's command is not finite
} flight_over_t;

// Returns whether the flight is over before tick 0, 1, 2, ... of tick_s each. motor_N: the last commands.
flight_over_t flight_over(const plan_t *plan, double tick_s, long tick, const body_t *body,
                          const double motor_N[PILOT_MOTORS]);

#endif
