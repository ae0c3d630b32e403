// loop6.h - one flight in six degrees of freedom: body, sensors, estimator and pilot at 1000/500/100/40/10
// Hz.
//
// The vehicle moves in steps of 2 ms, the commands with it; sensors, estimator and pilot run every
// millisecond. On both of its milliseconds the inertial sensors see the same instant.
#ifndef SIM_FLIGHT_LOOP6_H
#define SIM_FLIGHT_LOOP6_H

#include "body/body.h"
#include "crazyflie/pilot6.h"
#include "flight/loop.h"
#include "flight/record6.h"
#include "sense/ekf.h"
#include "sense/mocap.h"
#include "sense/noise6.h"

#define LOOP6_TICK_S   0.002
#define LOOP6_UP_AGE_S 0.07 // what the app takes an upward sample's age to be

// Stands between sensors and pilot, every millisecond: may edit what the pilot gets (nothing of it lasts
// until the next call), and look at the truth.
typedef void (*loop6_edit_t)(void *context, const body_t *truth, pilot6_in_t *in);

// How the flight is flown. The waypoints of `plan` are heights of the rotors' plane; x, y and yaw are held at
// 0.
typedef struct {
  plan_t plan; // its noise is not used
  noise6_t noise;
  mocap_param_t mocap; // period_s > 0: the estimator has motion capture in place of range and flow
  body_start_t start;  // used if in_flight; else at rest on the floor, motors off
  bool in_flight;
  double held_s;       // something holds the vehicle where it starts until then
  bool below_estimate; // set points count from the ceiling as the pilot thinks it (thesis C.3), if it does
  int record_every;    // ticks for a sample; 0: 5, that is 10 ms
  double take_off_s;   // the height is controlled from here on; before, the motors are off
  loop6_edit_t edit;   // null: none
  void *edit_context;
} plan6_t;

// What the pilot thinks, where it can be asked; may be null.
typedef void (*loop6_ask_t)(const void *state, thoughts_t *thoughts);

// Flies the plan. *record and *more get the samples (they must be empty; free them after use). The record's z
// is the height of the rotors' plane, its gap that of the nearest rotor. BAD_INPUT: a model that cannot
// fly. FAILED: no memory.
MUST_CHECK done_t loop6_fly(const plan6_t *plan, const model_t *model, const pilot6_t *pilot, loop6_ask_t ask,
                            record_t *record, record6_t *more, outcome_t *outcome, why_t *why);

#endif
