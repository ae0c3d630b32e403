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

// All of these signals are there.
static inline bool has(double *const v[SIG_COUNT], signals_t signals) {
  for (int i = 0; i < SIG_COUNT; i++)
    if ((signals & SIGNAL_BIT(i)) && !v[i]) return false;
  return true;
}

// Three signals that follow one another, at sample i; and the attitude.
static inline d3_t vector_at(double *const v[SIG_COUNT], signal_id_t first, int i) {
  return d3(v[first][i], v[first + 1][i], v[first + 2][i]);
}
static inline dq_t attitude_at(double *const v[SIG_COUNT], int i) {
  return (dq_t){v[SIG_QW][i], v[SIG_QX][i], v[SIG_QY][i], v[SIG_QZ][i]};
}

// Thrust of all rotors at these speeds.
static inline double thrust_of_speeds_N(double *const v[SIG_COUNT], const model_t *vehicle, int i) {
  double sum = 0.0;
  for (int k = SIG_W1; k <= SIG_W4; k++) sum += v[k][i] * v[k][i];
  return vehicle->frame.kf_Ns2 * sum;
}

// The log's rows as they came, but for what is merged: column by column.
typedef struct {
  int n, room;
  double *t_s;
  double *v[SIG_COUNT]; // null: not delivered
  bool *at_limit;
  long *line;
  double period_s;          // median distance of rows
  double slow_s[SIG_COUNT]; // usual distance of new values, where that is longer; else 0
  int thin;                 // rows of the log per row
  long rows;                // of the log
  long merged;              // rows at, or almost at, the time of the one before
  long range_unusable;      // samples of 0 and of no return
  bool acc_in_world;        // else in the body's axes
} raw_t;

void raw_free(raw_t *raw);
void raw_drop(raw_t *raw, signal_id_t signal);

// Reads rows until the end or GAP_FLIGHT_S. Thins to about GAP_RATE_HZ by means; merges rows of almost one
// time; keeps of the ranges what is new. BAD_INPUT: as log_rows_next, or the rows' distance is not that of
// a flight log.
MUST_CHECK done_t raw_read(raw_t *raw, log_rows_t *rows, bool *cut, why_t *why);

// One sentence more for the report.
#define gap_note(f, ...) text_line((f)->note, (f)->n_note, __VA_ARGS__)

// Counts what is no use, and says it. BAD_INPUT: too much of a column, or only some of the motors' columns.
MUST_CHECK done_t gap_check_cells(gap_flight_t *f, const raw_t *raw, const log_rows_t *rows, why_t *why);

// In row i the commands, or else the rotor speeds, carry it: 1, or not: 0. -1: cannot be told.
int raw_flies(const raw_t *raw, const model_t *vehicle, int i);

// BAD_INPUT: a signal that stands still while the vehicle flies. FAILED: no memory.
MUST_CHECK done_t raw_check_stuck(const raw_t *raw, const log_rows_t *rows, why_t *why);

// Heights from what z says where the vehicle stands on the floor: by the columns file, else by the rows
// before take-off, if z stands there at some point of the vehicle, and with a note. FAILED: no memory.
MUST_CHECK done_t raw_from_floor(gap_flight_t *f, raw_t *raw, const log_rows_t *rows, why_t *why);

// A slower stream repeats its last value until the next: makes the repeats gaps, so that what is between new
// values is a line and not a stair, which would be late by half a step. Returns in how many streams.
// FAILED: no memory.
MUST_CHECK done_t raw_free_of_repeats(raw_t *raw, int *streams, why_t *why);

// Accelerations that the log has in the world's axes came into the body's by the attitude of their row, which
// may be a repeated one, or of another time: back, until both are where they belong.
void raw_to_world(raw_t *raw);

// The uniform time base, with accelerations in the body's axes: shift_s[i] is taken from the time stamps of
// signal i. Signals not in `want` are left out; at most limit_s of flight. FAILED: no memory.
MUST_CHECK done_t gap_grid(gap_flight_t *f, raw_t *raw, signals_t want, const double shift_s[SIG_COUNT],
                           double limit_s, bool drop, why_t *why);

// A stream, what drives it, and a window of samples in which both say how far it moved.
typedef struct {
  double moved[3], driven[3];
  double ends[3]; // of the driving signal: last minus first
} window_t;

typedef struct {
  const char *what, *moves, *by; // in words
  signals_t need, late;          // without which nothing is told; what is late where the stream is
  signal_id_t stream, driver;    // the first of three columns of each
  int axis;                      // the first that tells how late
  double span_s, least;          // a window's length; what is a movement
  bool (*at)(const gap_flight_t *f, int i, int j, window_t *w); // false: not all there
} drive_t;

extern const drive_t GAP_TURN, GAP_PUSH, GAP_GO; // attitude by gyro, velocity by force, position by velocity

// Samples of a window; and the one that begins with sample i. False: a gap is in it.
int gap_drive_samples(const gap_flight_t *f, const drive_t *drive);
bool gap_drive_window(const gap_flight_t *f, const drive_t *drive, int i, window_t *w);

// How far a stream is behind what drives it.
typedef struct {
  double late_s, stderr_s; // stderr_s infinite: cannot be told
} skew_t;

skew_t gap_skew(const gap_flight_t *f, const drive_t *drive);

// So many times as far as another stream says one may move: what is beyond has another unit or sign.
#define SLOPE_MIN 0.3333
#define SLOPE_MAX 3.0

// BAD_INPUT: a range or a set point moves as far as the place only in another unit.
MUST_CHECK done_t gap_check_moves(const gap_flight_t *f, const log_rows_t *rows, why_t *why);

// BAD_INPUT: signals contradict physics or each other over the whole flight.
MUST_CHECK done_t gap_check(gap_flight_t *f, const log_rows_t *rows, why_t *why);

#endif
