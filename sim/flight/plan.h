// plan.h - what a flight flies: set points over time, its start and its end.
#ifndef SIM_FLIGHT_PLAN_H
#define SIM_FLIGHT_PLAN_H

#include "body/body.h"
#include "crazyflie/pilot.h"
#include "sense/mocap.h"
#include "sense/noise.h"
#include "sense/vertical.h"

#define WAYPOINTS_MAX 24

// From at_s on the set point is setpoint_m.
typedef struct {
  double at_s, setpoint_m;
} waypoint_t;

// Called between sensors and pilot, at every call of the pilot. It may edit what the pilot gets, for this
// call only, and look at the true state.
typedef void (*loop_edit_t)(void *context, const body_t *truth, pilot_in_t *in);

// How the flight is flown. The waypoints are heights of the rotors' plane; x, y and yaw are held at 0.
typedef struct {
  waypoint_t way[WAYPOINTS_MAX]; // at_s ascending, the first 0
  int n_way;
  double end_s; // when the flight is over (flight/over.h)
  uint64_t seed;
  integrate_kind_t integrate;
  double step_s;       // longest step of the integrator; 0: 2 ms
  double held_s;       // until then the vehicle is held where it starts
  bool below_estimate; // set points count from the pilot's estimate of the ceiling, if any (thesis C.3)
  int record_every;    // ticks per sample; 0: as many as make 10 ms
  double take_off_s;   // the height is controlled from here on; before, the motors are off
  loop_edit_t edit;    // null: none
  void *edit_context;
  // In six degrees of freedom.
  noise_t noise;
  mocap_param_t mocap; // period_s > 0: the estimator has motion capture in place of range and flow
  body_start_t start;  // used if in_flight; else at rest on the floor, motors off
  bool in_flight;
  // On the vertical axis; the vehicle is then a point, at its rotors' plane.
  bool vertical_only;
  double period_s; // of motion, sensors and pilot
  vertical_noise_t vertical_noise;
  double start_z_m; // 0: on the ground
  double start_thrust_N;
} plan_t;

#endif
