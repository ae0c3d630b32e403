// flight.h - a recorded flight in SI units on one time base, signal by signal: the input of all later stages.
#ifndef SIM_GAP_1_READ_FLIGHT_H
#define SIM_GAP_1_READ_FLIGHT_H

#include "base/error.h"
#include "logs/columns.h"
#include "vehicle/model.h"
#include <stdbool.h>

#define GAP_FLIGHT_S   1800.0 // at most this much of a log is used
#define GAP_RATE_HZ    500.0  // a faster log is thinned to this
#define GAP_CARRIED    0.3    // share of the weight: with less thrust the vehicle stands or falls
#define GAP_NOTES      16
#define GAP_NOTE_BYTES 200

typedef struct {
  char name[256]; // of the log, for messages
  int n;          // samples
  double *t_s;    // strictly increasing, uniform within a segment; the log's own zero
  // One array of n numbers for each signal (logs/columns.h). NaN: no value at this instant; null: not logged.
  // SIG_A*: specific force in body axes. SIG_QW..QZ: body to world, length 1, no jumps of sign.
  // SIG_ROLL..YAW: always null (see SIG_Q*). SIG_Z: 0 at rest on the floor, if the columns file or the rows
  // before take-off say where that is. SIG_M*: newton, or the argument of the vehicle's thrust map (0..65535,
  // or rad/s). SIG_F*: commanded thrust of each motor in free air, newton, by the map, whatever the log's
  // unit; null if the map or the voltage it needs is missing. SIG_THRUST: that of all motors together.
  // SIG_VBAT: the last value known. SIG_RANGE..: fresh samples only, NaN between them.
  double *v[SIG_COUNT];
  // True: a row is the mean of everything over its period. False: it holds the values at its time, and its
  // commands hold from then on.
  bool rows_are_means;
  bool motors_N;                         // SIG_M* are in newton
  char motor_column[4][COLUMN_NAME_MAX]; // the log's names of m1..m4; "": not logged
  const char *motor_lacks; // one of m1..m4, w1..w4 that is missing while its others are there; null: none
  double range_late_s[2];  // up, down: how long before its instant a sample was taken; less than a period
  bool *saturated;         // a motor was at a limit (the sample is masked)
  int *segment;            // 0, 1, 2..: a new one after every gap; filters start again
  double rate_Hz;          // of the uniform time base: that of the rows, at most GAP_RATE_HZ
  double command_Hz;       // how often the motors were commanded; 0: not known

  // What the reader found and corrected, for the report.
  double attitude_late_s; // removed delay of the attitude against the gyro; 0: none was seen
  double velocity_late_s; // ... of velocity and position against the accelerometer
  double position_late_s; // ... then of the position against the velocity, <= 0
  double floor_m;         // z before take-off, subtracted from all heights; 0: nothing was
  bool floor_known;       // the columns file, or the rows before take-off, say what z is on the floor
  long rows;              // rows of the log that were read
  long cells_bad;         // text or infinite: taken as missing
  long cells_missing;     // empty or nan
  bool cut;               // the log is longer than GAP_FLIGHT_S
  int n_note;
  char note[GAP_NOTES][GAP_NOTE_BYTES]; // one sentence each, with file, line and column where there is one
} gap_flight_t;

typedef struct {
  gap_flight_t *flight;
  int n;
} gap_flights_t;

// Reads a CSV or a uSD log, brings its streams to one uniform time base, masks, aligns and checks it. Signals
// that are not in the log are null. BAD_INPUT: not such a file, or signals that are out of range, stuck, or
// contradict physics or each other; names file, line and column. FAILED: no memory. *f is empty after either.
// The caller frees it.
MUST_CHECK done_t gap_read(gap_flight_t *f, const char *path, const columns_t *columns,
                           const model_t *vehicle, why_t *why);

void gap_flight_free(gap_flight_t *f);

#endif
