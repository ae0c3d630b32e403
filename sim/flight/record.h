// record.h - a flight in memory: one sample every 10 ms (on request 2 ms), or every tick of a slower
// controller.
#ifndef SIM_FLIGHT_RECORD_H
#define SIM_FLIGHT_RECORD_H

#include "base/error.h"
#include "pilots/controller.h"
#include "sense/ekf.h"
#include <stdbool.h>
#include <stdio.h>

typedef struct {
  double t_s, setpoint_m;
  double z_m, climb_mps, acc_mps2; // as it is
  double gap_m, gap_min_m;         // to the ceiling: now, and smallest since the last sample
  double thrust_N, command_N;      // of the rotors in free air; what was commanded at t_s
  double ratio;                    // what the effects multiply the thrust by
  int contacts;                    // with the ceiling, since the start
  bool touching;                   // the ceiling, at t_s
  sense_t sense;                   // as measured
  thoughts_t thoughts;             // as believed
} sample_t;

// What there is besides in six degrees of freedom.
typedef struct {
  double tilt_rad; // largest since the last sample
  double motor_N[4];
  d3_t pos_w_m;
  double vbat_V;
  ekf_out_t estimate;
  d3_t gyro_b_radps, acc_b_mps2; // as measured
  double setpoint_z_m;           // in the estimator's frame
  // As the firmware's control_t: units of 16 bit, 65535 for all that a motor can; yaw clockwise.
  double command_roll, command_pitch, command_yaw, command_thrust;
} sample6_t;

typedef struct {
  sample_t *sample;
  int n, room;
  sample6_t *more; // as many, or a null pointer: flown on the vertical axis
  float *app;      // as many rows of the app's logs (sections_logs()), or a null pointer
  int n_calls;     // not 0: `app` has a row for each call, so many, and only it is written
  float *param;    // what the app flew with, as params_table; or a null pointer
} record_t;

// Makes room for so many samples in all: what is known beforehand need not be moved while it grows.
// FAILED: no memory; nothing has changed.
MUST_CHECK done_t record_reserve(record_t *r, int room);

// FAILED: no memory; nothing was added.
MUST_CHECK done_t record_add(record_t *r, const sample_t *sample);

void record_free(record_t *r);

// Writes the flight as a CSV with Crazyflie log names (src/firmware/README.md, learn). The stream knows if
// that failed.
void record_write(const record_t *r, FILE *file);

#endif
