// pilot.h - the flight code at the controls of the simulated vehicle.
#ifndef SIM_PILOTS_PILOT_H
#define SIM_PILOTS_PILOT_H

#include "base/error.h"
#include "flight/outer.h"
#include "pilots/controller.h"

typedef struct {
  outer_t flight;
  flight_param_t param; // may be changed in flight
} pilot_t;

// BAD_INPUT: as outer_init.
MUST_CHECK done_t pilot_init(pilot_t *p, const flight_param_t *param, double period_s);

// *p must outlive the controller and stay where it is.
controller_t pilot_controller(pilot_t *p);

#endif
