// pilot_outer.h - the flight code's outer loop alone as a pilot: on the vertical axis there is nothing for
// the inner loop to do.
#ifndef SIM_PILOTS_PILOT_OUTER_H
#define SIM_PILOTS_PILOT_OUTER_H

#include "base/error.h"
#include "crazyflie/pilot.h"
#include "flight/outer.h"

typedef struct {
  outer_t flight;
  bool learned; // it learned at the last step
} pilot_outer_t;

// To be stepped every period_s; *p must stay where it is. BAD_INPUT: as outer_init.
MUST_CHECK done_t pilot_outer_init(pilot_outer_t *p, const flight_param_t *param, double period_s,
                                   pilot_t *pilot);

// Fills in what the outer loop believes; `y` is left as it is.
void pilot_outer_tell(const outer_t *flight, thoughts_t *thoughts);

#endif
