// controller.h - what flies: measurements in, thrust out, once per period. The flight code and its peers
// alike.
#ifndef SIM_PILOTS_CONTROLLER_H
#define SIM_PILOTS_CONTROLLER_H

#include <stdbool.h>

#define CURVE_WEIGHTS 7

typedef struct {
  double setpoint_m;
  double z_m, climb_mps; // as estimated
  double acc_mps2;       // as measured, vertical, without gravity
  double applied_N;      // thrust command that was applied since the last call
  double motor_N;        // what the rotors would give in free air (no Crazyflie measures it: for peers)
  bool range_new;        // range_m was not there at the last call
  double range_m;        // upward range sensor
} sense_t;

// What a controller thinks, for logs. NaN or 0 where it has no such thought.
typedef struct {
  double zc_m;               // ceiling distance; NaN: none known
  double ceiling_z_m;        // height of the ceiling, latched (flight/hold.h); NaN: none known
  double ratio, slope_per_m; // of the believed curve
  double y;                  // the ratio that taught the curve at this tick; NaN: none did
  double weights[CURVE_WEIGHTS];
  double variance[CURVE_WEIGHTS];    // of the weights
  unsigned guard_now, guard_latched; // reasons of the guard (flight/guard.h)
} thoughts_t;

typedef struct {
  void *state;
  double period_s;
  double (*step)(void *state, const sense_t *in, thoughts_t *thoughts); // newton
} controller_t;

#endif
