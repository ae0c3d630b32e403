// over.h - when a flight is over.
#ifndef SIM_FLIGHT_OVER_H
#define SIM_FLIGHT_OVER_H

#include "flight/plan.h"

typedef enum {
  FLIGHT_FLIES,
  FLIGHT_TIME_UP,    // the plan's end_s has passed
  FLIGHT_NOT_FINITE, // a state of the body, or a motor's command, is no number
} flight_over_t;

// Before tick 0, 1, 2, ... of tick_s each; motor_N: what was ordered last.
flight_over_t flight_over(const plan_t *plan, double tick_s, long tick, const body_t *body,
                          const double motor_N[PILOT_MOTORS]);

#endif
