// setup6.h - everything that one flight in six degrees of freedom needs, and what it was like.
#ifndef SIM_FLIGHT_SETUP6_H
#define SIM_FLIGHT_SETUP6_H

#include "flight/loop6.h"
#include "flight/setup.h"
#include "pilots/air_garage.h"

typedef struct {
  model_t model;
  flight_param_t flight;
  rbf_weights_t learn_from; // what a learning flight starts with
  fly_kind_t kind;
  stock_pid_param_t stock_pid;
  air_garage_param_t air_garage; // infinitely far ceiling: it gets the model's, counted from the propellers
  plan6_t plan;
  const request_t *request; // parameters of the app, and whether its logs are kept; null: neither
} setup6_t;

// The thesis's experiments: a Crazyflie 2.1 with both decks under a ceiling at 0.5 m whose effect is
// 1 + 0.44 exp(-80 zc) at every rotor; sensors as bad as the real ones; the flight code as it ships.
// BAD_INPUT: a fault of the build, not of the user.
MUST_CHECK done_t setup6_thesis(setup6_t *setup, fly_kind_t kind, why_t *why);

// The firmware's controllers get the propellers of the vehicle. BAD_INPUT: as request_apply, or a
// controller or a noise of the vertical axis, or for the firmware's controllers parameters or propellers that
// they do not know.
MUST_CHECK done_t setup6_apply(setup6_t *setup, const request_t *request, why_t *why);

// The thesis's flights stay below the range sensor's floor for longer than the guard of the shipped set
// allows: ceil.blindMax for them.
#define SETUP6_BLIND_S 60.0f

// Waypoints at these gaps below the ceiling, hold_s each, after a take-off and a hover at the first: below
// the ceiling as the controller thinks it; who thinks of none is told where it is.
void setup6_ladder(setup6_t *setup, const double *gap_m, int n, double hold_s);

// That of the close flight and of the learning flight: 20 cm, then 10 to 2 cm in steps of 2 cm, 10 s each.
void setup6_close_ladder(setup6_t *setup);

typedef struct {
  flown_t flown; // outcome, record, segments, weights
  record6_t more;
  double tilt_max_rad[WAYPOINTS_MAX]; // of each segment
} flown6_t;

// BAD_INPUT: as loop6_fly; then nothing is left to free. Else free what was flown.
MUST_CHECK done_t setup6_fly(const setup6_t *setup, flown6_t *flown, why_t *why);

void flown6_free(flown6_t *flown);

#endif
