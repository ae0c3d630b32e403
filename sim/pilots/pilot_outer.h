// pilot_outer.h - the flight code's outer loop alone at the controls: on the vertical axis there is nothing
// for the inner one to do.
#ifndef SIM_PILOTS_PILOT_OUTER_H
#define SIM_PILOTS_PILOT_OUTER_H

#include "base/error.h"
#include "crazyflie/pilot.h"
#include "flight/outer.h"

typedef struct {
  outer_t flight;
  bool learned; // at the last step
} pilot_outer_t;

// To be stepped every period_s; *p must stay where it is. BAD_INPUT: as outer_init.
MUST_CHECK done_t pilot_outer_init(pilot_outer_t *p, const flight_param_t *param, double period_s,
                                   pilot_t *pilot);

// What the outer loop thinks; `y` is left.
void pilot_outer_tell(const outer_t *flight, thoughts_t *thoughts);

#endif
