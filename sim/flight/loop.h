// loop.h - one flight: body, sensors, estimator and pilot.
//
// In six degrees of freedom the vehicle moves, and commands act, in ticks of 2 ms; sensors, estimator and
// pilot are called every millisecond and run at their 1000/500/100/40/10 Hz. In both milliseconds of a tick
// the inertial sensors see the same instant. On the vertical axis alone motion, sensors and pilot have one
// period, and measurements are exact but for white noise (sense/vertical.h).
#ifndef SIM_FLIGHT_LOOP_H
#define SIM_FLIGHT_LOOP_H

#include "flight/drawn.h"
#include "flight/loop_parts.h"
#include "flight/plan.h"
#include "flight/record.h"

typedef struct {
  int contacts;           // with the ceiling
  bool finite;            // the state and every command stayed finite
  drawn_t drawn;          // six degrees of freedom: this flight's random deviations
  double realtime_factor; // flight time over computing time; differs from run to run
} outcome_t;

// Flies the plan, with the vehicle, sensors and air that its seed draws (flight/drawn.h). *record gets the
// samples (it must be empty; free it after use). Its z is the height of the rotors' plane, its gap that of
// the nearest rotor. BAD_INPUT: a model that cannot fly. FAILED: no memory.
MUST_CHECK done_t loop_fly(const plan_t *plan, const model_t *model, const pilot_t *pilot, record_t *record,
                           outcome_t *outcome, why_t *why);

// Opens the same flight for a caller that sets the pace, tick by tick (flight/loop_parts.h). plan, model and
// pilot must outlive the loop. Errors as loop_fly; *loop is null then.
MUST_CHECK done_t loop_open(flight_loop_t **loop, const plan_t *plan, const model_t *model,
                            const pilot_t *pilot, drawn_t *drawn, why_t *why);

// Return what flies. Between two ticks the caller may change it: numbers of effects that are on, the ceiling
// with its surface, charge, pushes, the estimate.
body_t *loop_body(flight_loop_t *loop);
model_t *loop_model(flight_loop_t *loop);
ekf_t *loop_estimator(flight_loop_t *loop);

// A null pointer is allowed.
void loop_close(flight_loop_t *loop);

#endif
