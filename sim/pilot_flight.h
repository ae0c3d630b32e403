// pilot_flight.h - the whole flight code as one that flies in six degrees of freedom.
#ifndef SIM_PILOT_FLIGHT_H
#define SIM_PILOT_FLIGHT_H

#include "flight/flight.h"
#include "pilot6.h"

typedef struct {
  flight_t flight;
  flight_param_t param; // may be changed in flight
} pilot_flight_t;

// ST_BAD_PARAM: as flight_init. *p must outlive *pilot and stay where it is.
MUST_CHECK status_t pilot_flight_init(pilot_flight_t *p, const flight_param_t *param, pilot6_t *pilot);

#endif
