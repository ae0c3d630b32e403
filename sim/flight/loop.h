// loop.h - one flight: world, sensors, estimator and controller together.
#ifndef SIM_FLIGHT_LOOP_H
#define SIM_FLIGHT_LOOP_H

#include "base/error.h"
#include "flight/record.h"
#include "pilots/controller.h"
#include "plant/integrate.h"
#include "sense/sensors.h"
#include "vehicle/model.h"
#include <stdint.h>

#define WAYPOINTS_MAX 24

// From at_s on the set point is setpoint_m.
typedef struct {
  double at_s, setpoint_m;
} waypoint_t;

typedef struct {
  waypoint_t way[WAYPOINTS_MAX]; // at_s ascending, the first 0
  int n_way;
  double end_s;
  double start_z_m; // 0: on the ground
  double start_thrust_N;
  noise_t noise;
  uint64_t seed;
  integrate_kind_t integrate;
  double step_s; // of the integrator, at most; 0: 2 ms
} plan_t;

typedef struct {
  int contacts;           // with the ceiling
  bool finite;            // the state and every command stayed finite
  double realtime_factor; // flight time over computing time; differs from run to run
} outcome_t;

// Flies the plan. *record gets the samples (it must be empty; free it after use).
// FAILED: no memory, or a plan out of range.
MUST_CHECK done_t loop_fly(const plan_t *plan, const model_t *model, const controller_t *controller,
                           record_t *record, outcome_t *outcome, why_t *why);

#endif
