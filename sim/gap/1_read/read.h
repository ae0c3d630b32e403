// read.h - the parts of stage 1, in the order in which they run. Only the 1_read files include it.
#ifndef SIM_GAP_1_READ_READ_H
#define SIM_GAP_1_READ_READ_H

#include "base/d3.h"
#include "base/text.h"
#include "gap/1_read/flight.h"
#include "logs/log_rows.h"

#define PLACE    SIGNALS(SIG_X, SIG_Z)
#define VELOCITY SIGNALS(SIG_VX, SIG_VZ)
#define ATTITUDE SIGNALS(SIG_QW, SIG_QZ)
#define GYRO     SIGNALS(SIG_GX, SIG_GZ)
#define FORCE    SIGNALS(SIG_AX, SIG_AZ)
#define COMMANDS SIGNALS(SIG_M1, SIG_M4)
#define SPEEDS   SIGNALS(SIG_W1, SIG_W4)

// True if all of these signals are there.
static inline bool has(double *const v[SIG_COUNT], signals_t signals) {
  for (int i = 0; i < SIG_COUNT; i++)
    if ((signals & SIGNAL_BIT(i)) && !v[i]) return false;
  return true;
}

// Return three consecutive signals, and the attitude, at sample i.
static inline d3_t vector_at(double *const v[SIG_COUNT], signal_id_t first, int i) {
  return d3(v[first][i], v[first + 1][i], v[first + 2][i]);
}
static inline dq_t attitude_at(double *const v[SIG_COUNT], int i) {
  return (dq_t){v[SIG_QW][i], v[SIG_QX][i], v[SIG_QY][i], v[SIG_QZ][i]};
}

// Returns the thrust of all rotors at their measured speeds.
static inline double thrust_of_speeds_N(double *const v[SIG_COUNT], const model_t *vehicle, int i) {
  double sum = 0.0;
  for (int k = SIG_W1; k <= SIG_W4; k++) sum += v[k][i] * v[k][i];
  return vehicle->frame.kf_Ns2 * sum;
}

// The log's rows, column by column, as they were read but for thinning and merging.
typedef struct {
  int n, room;
  double *t_s;
  double *v[SIG_COUNT]; // null: not delivered
  bool *at_limit;
  long *line;
  double period_s;          // median time between rows of the log
  double slow_s[SIG_COUNT]; // usual time between new values of a stream slower than the log; else 0
  int thin;                 // rows of the log in one row here
  long rows;                // of the log
  long merged;              // rows at, or almost at, the time of the one before
  long range_unusable;      // samples of 0 and of no return
  bool acc_in_world;        // accelerations are in world axes; else in body axes
} raw_t;

void raw_free(raw_t *raw);
void raw_drop(raw_t *raw, signal_id_t signal);

// Reads rows until the end or GAP_FLIGHT_S. Averages rows down to about GAP_RATE_HZ, merges rows of almost
// the same time, keeps only new range samples. BAD_INPUT: as log_rows_next, or the time between rows is not
// that of a flight log. FAILED: no memory.
MUST_CHECK done_t raw_read(raw_t *raw, log_rows_t *rows, bool *cut, why_t *why);

// Adds a sentence to the report.
#define gap_note(f, ...) text_line((f)->note, (f)->n_note, __VA_ARGS__)

// Counts and notes cells that are of no use. BAD_INPUT: too many in one column, only some of the motors'
// columns, or commands that cannot be converted to newton. FAILED: no memory.
MUST_CHECK done_t gap_check_cells(gap_flight_t *f, const raw_t *raw, const log_rows_t *rows, why_t *why);

// Returns 1 if the commands of row i, or else the rotor speeds, carry the vehicle, 0 if not, -1 if unknown.
int raw_flies(const raw_t *raw, const model_t *vehicle, int i);

// BAD_INPUT: a signal stands still while the vehicle flies, or a sensor does throughout. FAILED: no memory.
MUST_CHECK done_t raw_check_stuck(const raw_t *raw, const log_rows_t *rows, why_t *why);

// Makes heights count from z at rest on the floor: by the columns file, else, with a note, by the rows before
// take-off, if z is still there and at most the vehicle's width from 0. FAILED: no memory.
MUST_CHECK done_t raw_from_floor(gap_flight_t *f, raw_t *raw, const log_rows_t *rows, why_t *why);

// Turns the repeats of streams slower than the log into gaps, so that lines connect the new values. Repeats
// would make a staircase, which is late by half a step. *streams: how many streams had them. FAILED: no
// memory.
MUST_CHECK done_t raw_free_of_repeats(raw_t *raw, int *streams, why_t *why);

// Turns accelerations that were logged in world axes back into these. log_rows turned them into body axes by
// the attitude of their row, which may be a repeated one or of another time; gap_grid turns them again once
// both are on the time base.
void raw_to_world(raw_t *raw);

// Puts the signals in `want` on the uniform time base, accelerations in body axes, at most limit_s of flight.
// shift_s[i] is subtracted from the time stamps of signal i. drop: frees each column of raw once it is used.
// FAILED: no memory.
MUST_CHECK done_t gap_grid(gap_flight_t *f, raw_t *raw, signals_t want, const double shift_s[SIG_COUNT],
                           double limit_s, bool drop, why_t *why);

// How far a stream moved over a window of samples: as measured, and by the integral of its driving signal.
typedef struct {
  double moved[3], driven[3];
  double ends[3]; // the driving signal's last value minus its first
} window_t;

typedef struct {
  const char *what, *moves, *by; // in words: stream, verb, driver
  signals_t need, late;          // signals that are needed; signals that are as late as the stream
  signal_id_t stream, driver;    // the first of three columns of each
  int axis;                      // the delay is estimated from this axis on
  double span_s, least;          // length of a window; least movement that counts
  bool (*at)(const gap_flight_t *f, int i, int j, window_t *w); // false: the window cannot be used
} drive_t;

extern const drive_t GAP_TURN, GAP_PUSH, GAP_GO; // attitude by gyro, velocity by force, position by velocity

// Returns a window's length in samples.
int gap_drive_samples(const gap_flight_t *f, const drive_t *drive);
// Fills *w with the window that begins at sample i. False: a gap, an impact or a missing value is in it.
bool gap_drive_window(const gap_flight_t *f, const drive_t *drive, int i, window_t *w);

// Delay of a stream against the signal that drives it.
typedef struct {
  double late_s, stderr_s; // stderr_s infinite: the flight cannot tell
} skew_t;

skew_t gap_skew(const gap_flight_t *f, const drive_t *drive);

// Bounds of a stream's movement over that which another stream gives: beyond, a unit or a sign is wrong.
#define SLOPE_MIN 0.3333
#define SLOPE_MAX 3.0

// BAD_INPUT: a range or a set point would move as far as the position in another unit only.
MUST_CHECK done_t gap_check_moves(const gap_flight_t *f, const log_rows_t *rows, why_t *why);

// Notes a scale that is slightly off. BAD_INPUT: signals contradict physics or each other over the whole
// flight.
MUST_CHECK done_t gap_check(gap_flight_t *f, const log_rows_t *rows, why_t *why);

#endif
