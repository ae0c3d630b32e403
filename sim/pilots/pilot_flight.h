// pilot_flight.h - the whole flight code as a pilot in six degrees of freedom: the app as it runs on the
// vehicle, with the firmware's units in between (crazyflie/crazyflie.h).
#ifndef SIM_PILOTS_PILOT_FLIGHT_H
#define SIM_PILOTS_PILOT_FLIGHT_H

#include "crazyflie/crazyflie.h"

typedef struct {
  crazyflie_t vehicle;
  flight_t *flight;     // its app's
  flight_param_t param; // may be changed in flight, after crazyflie_home(): changes are written to the
                        // app's parameters
  flight_param_t sent;
  float *log; // rows of the app's logs; null unless kept; the caller frees it
  int n_log, room_log;
  int log_width;    // logs of the app
  int log_every_ms; // 10, 2 or 1; 0: none is kept
} pilot_flight_t;

// model: the vehicle whose motors are driven; null: legacy propellers. *p must stay where it is. BAD_INPUT:
// parameters that params_check refuses. FAILED: a parameter that the app does not have. p->log_every_ms may
// be set afterwards.
MUST_CHECK done_t pilot_flight_init(pilot_flight_t *p, const flight_param_t *param, const model_t *model,
                                    pilot_t *pilot);

#endif
