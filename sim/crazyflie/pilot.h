// pilot.h - the interface of whatever flies, the flight code and its peers alike: measurements and a set
// point in, four motor forces out, every millisecond (on the vertical axis alone: every period of the plan).
//
// World x, y level, z up; body x forward, y left, z up. Motors as on the Crazyflie, seen from above: m1 front
// right, m2 back right, m3 back left, m4 front left; the drag of m1 and m3 turns the body clockwise, that of
// m2 and m4 counter-clockwise. A pilot that does not run at every call keeps its last output.
#ifndef SIM_CRAZYFLIE_PILOT_H
#define SIM_CRAZYFLIE_PILOT_H

#include "base/d3.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define PILOT_MOTORS   4
#define CURVE_WEIGHTS  7
#define PILOT_PERIOD_S 1e-3

typedef enum {
  PILOT_OFF,      // x or y: fly level; z: thrust_N is what the motors give
  PILOT_POSITION, // hold the position; velocity and acceleration are feed-forward
  PILOT_VELOCITY, // hold the velocity; acceleration is feed-forward
} pilot_mode_t;

typedef struct {
  pilot_mode_t mode[3]; // x, y, z; of the world, or of the heading while vel_in_body
  d3_t pos_w_m;
  bool vel_in_body; // vel_mps is along the heading: x forward, y left, z up; else along the world's axes
  d3_t vel_mps;
  d3_t acc_w_mps2;               // without gravity
  double roll_rad, pitch_up_rad; // used if x or y is off; 0: level. Right-hand about x; nose up
  bool yaw_by_rate;
  double yaw_rad;        // counter-clockwise from above, any number of turns; unless yaw_by_rate
  double yaw_rate_radps; // if yaw_by_rate
  double thrust_N;       // of all motors together, used if z is off; 0: the motors stop
} pilot_setpoint_t;

typedef struct {
  uint32_t step;                  // counts calls
  d3_t gyro_b_radps;              // as measured
  d3_t acc_b_mps2;                // as measured: specific force, +9.81 on z at rest
  d3_t pos_w_m, vel_w_mps;        // as estimated
  dq_t q_wb;                      // as estimated; of length 1
  double applied_N[PILOT_MOTORS]; // command that was applied since the last call, after its limits
  double rotors_N; // thrust of all rotors in free air; for peers, since no Crazyflie measures it
  double vbat_V;   // as measured
  bool range_new;  // range_m is a sample that the last call did not have
  double range_m;  // upward range sensor, along body z; NaN: no valid distance
  bool down_new;   // likewise, of down_m
  double down_m;   // downward range sensor
  pilot_setpoint_t set;
} pilot_in_t;

// What a pilot believes, for logs. NaN or 0 where it has no such estimate.
typedef struct {
  double zc_m;               // ceiling distance; NaN: none known
  double ceiling_z_m;        // height of the ceiling, latched (flight/hold.h); NaN: none known
  double ratio, slope_per_m; // of the believed curve
  double y;                  // the ratio that the curve learned from at this tick; NaN: none
  double weights[CURVE_WEIGHTS];
  double variance[CURVE_WEIGHTS];    // of the weights
  unsigned guard_now, guard_latched; // reasons of the guard (flight/guard.h)
} thoughts_t;

// For code around a vehicle that edits the pilot's input (plan_t.edit) and reads the app's state.
typedef struct {
  size_t from, to;
} pilot_part_t;
typedef struct {
  const pilot_part_t *part; // of the app's state (glue_t), in bytes: parts that are read between milliseconds
  int n;
  // Called after each millisecond of the vehicle in which step() is not called; in: as edited.
  void (*after)(void *state, const pilot_in_t *in, const double motor_N[PILOT_MOTORS]);
} pilot_around_t;

typedef struct {
  void *state;
  // Fills motor_N, m1..m4, each finite.
  void (*step)(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]);
  void (*reset)(void *state); // as after power-on; parameters stay
  // Overwrites the members that the pilot knows; null: it tells nothing.
  void (*tell)(const void *state, thoughts_t *thoughts);
  // Set if step() only runs crazyflie_ms() of this vehicle and keeps its log: such pilots can fly together
  // (flight/together.h).
  struct crazyflie *vehicle; // null: any other pilot
  // True if the pilot keeps a row at the end of this millisecond; null: never. One that ever does keeps that
  // of step 1.
  bool (*keeps)(const void *state, uint32_t step);
  void (*keep)(void *state);
  const pilot_around_t *around; // null: no such code reads its state
} pilot_t;

#endif
