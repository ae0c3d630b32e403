// replay.h - a recorded flight's inputs through the flight code: does it command what was logged?
//
// The log has every call of the app, a row each, with its groups indiIn and indiSet (what the flight code was
// given) and indi.m1..m4 (what it commanded): fly --log-rate 1000 writes it. It begins with the call at which
// the controller was selected; a step counter that leaps is a missed call, as in flight. The parameters are
// those of the whole flight.
#ifndef SIM_REPLAY_H
#define SIM_REPLAY_H

#include "error.h"
#include "flight/params.h"

typedef struct {
  long calls, missing; // missing: between two rows, by the step counter
  long differ;         // differ: a motor's command is not the logged one, bit for bit
  long first_line;     // of the log that differs; 0: none
  double worst_N;      // largest difference of a motor
} replay_t;

// ST_BAD_INPUT: no such log, a column is missing or not a number. ST_BAD_PARAM as flight_init.
MUST_CHECK status_t replay_fly(const char *path, const flight_param_t *param, replay_t *result, why_t *why);

#endif
