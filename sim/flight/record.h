// record.h - a flight in memory, one sample every 10 ms (on request 2 ms) or every tick of a slower loop; and
// the flight as a log.
#ifndef SIM_FLIGHT_RECORD_H
#define SIM_FLIGHT_RECORD_H

#include "base/error.h"
#include "body/body.h"
#include "crazyflie/pilot.h"
#include "sense/ekf.h"
#include "sense/truth.h"
#include <stdbool.h>
#include <stdio.h>

typedef struct {
  double t_s, setpoint_m;
  double z_m, climb_mps, acc_mps2; // true; z of the rotors' plane
  double gap_m, gap_min_m;         // to the ceiling: now, and smallest since the last sample
  double thrust_N, command_N;      // of the rotors in free air; what was commanded at t_s
  double ratio;                    // what the effects multiply the thrust of rotor 0 by
  int contacts;                    // with the ceiling, since the start
  bool touching;                   // the ceiling, at t_s
  struct {
    double z_m, climb_mps, acc_mps2; // without gravity
    double applied_N;                // thrust command applied since the call before
    bool range_new;                  // since the last sample
    double range_m;                  // the newest, of the upward sensor
  } sense;                           // as measured
  thoughts_t thoughts;               // what the pilot believes
  double tilt_rad;                   // largest since the last sample
  double motor_N[PILOT_MOTORS];
  d3_t pos_w_m;
  double vbat_V;
  ekf_out_t estimate;
  d3_t gyro_b_radps, acc_b_mps2; // as measured
  double setpoint_z_m;           // in the estimator's frame
  // As the firmware's control_t: 16-bit units, 65535 is all that a motor can give; yaw clockwise.
  double command_roll, command_pitch, command_yaw, command_thrust;
} sample_t;

typedef struct {
  sample_t *sample;
  int n, room;
  bool vertical_only; // the log then has no columns of what cannot move
  float *app;         // a row of sections_logs() app logs for each sample, or a null pointer
  int n_calls;        // > 0: `app` has so many rows, one for each call, and the log is these alone
  float *param;       // what the flight code flew with, in the order of params_table; or a null pointer
} record_t;

// What the loop saw at one tick. Only what goes into the sample is kept.
typedef struct {
  double t_s, setpoint_m; // of the rotors' plane
  const body_t *body;
  const truth_t *truth;
  const pilot_in_t *in;
  const ekf_out_t *estimate;
  const double *motor_N;      // PILOT_MOTORS commands, before their limits
  const thoughts_t *thoughts; // of the pilot
  double up_min, gap_min_m;   // smallest since the last sample: cosine of the tilt, nearest rotor's gap
  bool range_new;             // since the last sample
  double range_m;             // the newest
} tick_t;

// Makes room for so many samples in all, so that a record of known length is not moved while it grows.
// FAILED: no memory; nothing has changed.
MUST_CHECK done_t record_reserve(record_t *r, int room, why_t *why);

// Adds the tick's sample. FAILED: no memory; nothing was added.
MUST_CHECK done_t record_add(record_t *r, const tick_t *tick, why_t *why);

void record_free(record_t *r);

// The log in parts, for a flight that is longer than memory: the header row once, then each time the rows
// that the record holds.
void record_write_names(const record_t *r, FILE *file);
void record_write_rows(const record_t *r, FILE *file);

// Writes the flight as a CSV with Crazyflie log names (src/firmware/README.md, learn). A failure shows in the
// stream (ferror).
void record_write(const record_t *r, FILE *file);

#endif
