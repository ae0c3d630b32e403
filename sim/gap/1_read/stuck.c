// stuck.c - stage 1: finds values that stand still, because a stream is slow or because a sensor hangs.
#include "gap/1_read/read.h"

#include "base/constants.h"
#include "base/by_size.h"
#include <math.h>
#include <stdlib.h>

#define REPEATS_MIN 0.2 // share of repeated rows from which on a stream is slower than the log
#define REPEATS_S   0.1 // a longer run is no repeat: the value stands still
#define REPEATS_RUN 3.0 // ... unless the stream is that slow: in usual runs
#define STUCK_RUNS  5.0 // a signal that is stuck stands for as many usual runs
#define RUN_ROWS    10
#define OTHERS_MOVE 0.5  // of stuck_s: other signals have moved for so long
#define MOVES       0.02 // of the weight, or m/s: a noise-free log that settles moves less while others stand
#define CLIMB_S                                                                                              \
  0.1 // s, over which a climb rate is averaged: 1 cm/s of white noise is no movement then, from 100 Hz on

// Signals that cannot stand still together while the vehicle flies.
typedef struct {
  signal_id_t first;
  int n;          // signals
  double stuck_s; // for this time in flight
  double way_m;   // ... and over this way, by the speed
} group_t;

static const group_t GROUP[] = {
    {SIG_AX, 1, 0.5, 0.0}, {SIG_AY, 1, 0.5, 0.0}, {SIG_AZ, 1, 0.5, 0.0}, {SIG_GX, 1, 0.5, 0.0},
    {SIG_GY, 1, 0.5, 0.0}, {SIG_GZ, 1, 0.5, 0.0}, {SIG_QW, 4, 0.5, 0.0}, {SIG_M1, 4, 0.5, 0.0},
    {SIG_VX, 3, 1.0, 0.1}, {SIG_X, 3, 1.0, 0.1},  {SIG_W1, 4, 0.5, 0.0}, {SIG_VBAT, 1, 10.0, 0.0},
};
// A simulator without a battery logs a constant voltage: its user knows, and says so in a columns file.
#define NO_BATTERY " (without a battery: vbat = {value = ..., unit = \"V\"} in a columns file)"

// ... and one without noise may hover exactly, so that a sensor reads nothing but zero.
#define NO_NOISE " (a simulator without noise: let it begin beside its set point)"

#define N_GROUP ((int)(sizeof GROUP / sizeof *GROUP))

// Streams that may have a rate of their own.
static const struct {
  signal_id_t first;
  int n;
} STREAM[] = {{SIG_X, 3}, {SIG_VX, 3}, {SIG_AX, 3}, {SIG_QW, 4}, {SIG_GX, 3}, {SIG_W1, 4}};
#define STREAMS ((int)(sizeof STREAM / sizeof *STREAM))

static bool logged(const raw_t *raw, signal_id_t first, int n) {
  return has(raw->v, SIGNALS(first, (int)first + n - 1));
}

static bool same(const raw_t *raw, signal_id_t first, int n, int i) {
  for (int k = 0; k < n; k++)
    if (!(raw->v[(int)first + k][i] == raw->v[(int)first + k][i - 1])) return false;
  return true;
}

// Finds the median time from one new value to the next; 0: too few new values.
static done_t usual_run(const raw_t *raw, signal_id_t first, int n, double *run_s, why_t *why) {
  double *const runs_s = malloc((size_t)raw->n * sizeof *runs_s);
  if (!runs_s) return error_failed(why, "out of memory");
  int runs = 0, from = 0;
  for (int i = 1; i < raw->n; i++) {
    if (same(raw, first, n, i)) continue;
    runs_s[runs++] = raw->t_s[i] - raw->t_s[from];
    from = i;
  }
  qsort(runs_s, (size_t)runs, sizeof *runs_s, by_size);
  *run_s = runs > RUN_ROWS ? runs_s[runs / 2] : 0.0;
  free(runs_s);
  return DONE;
}

static void drop_repeats(raw_t *raw, signal_id_t first, int n, double longest_s) {
  for (int i = 1, end; i < raw->n; i = end) {
    for (end = i; end < raw->n && same(raw, first, n, end);) end++;
    const bool stands = end > i && raw->t_s[end - 1] - raw->t_s[i - 1] > longest_s;
    for (int j = i; j < end && !stands; j++)
      for (int k = 0; k < n; k++) raw->v[(int)first + k][j] = (double)NAN;
    if (end == i) end++;
  }
}

done_t raw_free_of_repeats(raw_t *raw, int *streams, why_t *why) {
  *streams = 0;
  for (int s = 0; s < STREAMS; s++) {
    const signal_id_t first = STREAM[s].first;
    const int n = STREAM[s].n;
    double run_s;
    int repeats = 0;
    if (!logged(raw, first, n)) continue;
    for (int i = 1; i < raw->n; i++) repeats += same(raw, first, n, i);
    if (repeats < REPEATS_MIN * raw->n) continue;
    TRY(usual_run(raw, first, n, &run_s, why));
    drop_repeats(raw, first, n, fmax(REPEATS_S, REPEATS_RUN * run_s));
    for (int k = 0; k < n; k++) raw->slow_s[(int)first + k] = run_s;
    (*streams)++;
  }
  return DONE;
}

int raw_flies(const raw_t *raw, const model_t *vehicle, int i) {
  const double weight_N = vehicle->mass_kg * G_MPS2;
  if (raw->v[SIG_THRUST]) return raw->v[SIG_THRUST][i] > GAP_CARRIED * weight_N;
  return has(raw->v, SPEEDS) ? thrust_of_speeds_N(raw->v, vehicle, i) > GAP_CARRIED * weight_N : -1;
}

static double speed_mps(const raw_t *raw, int i) {
  const double speed = has(raw->v, VELOCITY) ? d3_norm(vector_at(raw->v, SIG_VX, i)) : 0.0;
  return isfinite(speed) ? speed : 0.0;
}

// Returns the mean climb rate of the rows from..end-1 that have one; NaN: none has.
static double climb_mps(const raw_t *raw, int from, int end) {
  double sum_mps = 0.0;
  int n = 0;
  for (int i = from; i < end; i++)
    if (isfinite(raw->v[SIG_VZ][i])) sum_mps += raw->v[SIG_VZ][i], n++;
  return n ? sum_mps / n : (double)NAN;
}

// Returns the change of the climb rate from the first rows of a stretch to its last ones, CLIMB_S each; NaN:
// not known.
static double climbs_mps(const raw_t *raw, int from, int i) {
  int rows = 1;
  while (from + rows < i && raw->t_s[from + rows] - raw->t_s[from] < CLIMB_S) rows++;
  return i - from < 2 * rows ? (double)NAN
                             : climb_mps(raw, i + 1 - rows, i + 1) - climb_mps(raw, from, from + rows);
}

// True if thrust or climb rate changed between two rows, or neither is logged: in a simulated hover
// everything but noise that was added may stand still, the commands too.
static bool moved(const raw_t *raw, const model_t *vehicle, int from, int i) {
  const double *const thrust_N = raw->v[SIG_THRUST], *const climb_mps = raw->v[SIG_VZ];
  if (!thrust_N && !climb_mps) return true;
  return (thrust_N && fabs(thrust_N[i] - thrust_N[from]) > MOVES * vehicle->mass_kg * G_MPS2) ||
         (climb_mps && fabs(climbs_mps(raw, from, i)) > MOVES);
}

static const char *unless_simulated(signal_id_t signal, double value) {
  if (signal == SIG_VBAT) return NO_BATTERY;
  return signal >= SIG_AX && signal <= SIG_GZ && value == 0.0 ? NO_NOISE : "";
}

static done_t check_group(const raw_t *raw, const log_rows_t *rows, const group_t *g, why_t *why) {
  int from = 0, whole = 0;
  double others_s = HUGE_VAL; // when other signals began to move
  double way_m = 0.0, run_s;
  TRY(usual_run(raw, g->first, g->n, &run_s, why));
  const double stuck_s = fmax(g->stuck_s, STUCK_RUNS * run_s);
  for (int i = 1; i < raw->n; i++) {
    const int flying = raw_flies(raw, &rows->vehicle, i);
    const bool stands = same(raw, g->first, g->n, i);
    whole += stands;
    if (!stands || flying == 0 || (g->first == SIG_M1 && raw->at_limit[i])) {
      from = i;
      way_m = 0.0;
      others_s = HUGE_VAL;
      continue;
    }
    const double span_s = raw->t_s[i] - raw->t_s[from];
    way_m += speed_mps(raw, i) * (raw->t_s[i] - raw->t_s[i - 1]);
    if (moved(raw, &rows->vehicle, from, i)) others_s = fmin(others_s, raw->t_s[i]);
    const bool moves = raw->t_s[i] - others_s >= OTHERS_MOVE * g->stuck_s && (flying == 1 || g->way_m > 0.0);
    if (!moves || span_s < stuck_s || i - from < RUN_ROWS || way_m < g->way_m) continue;
    return table_refuse(&rows->table, raw->line[from], rows->at[g->first], why,
                        "stands at %.6g %s for %.2f s and longer in flight; is the sensor stuck?%s",
                        raw->v[g->first][i], columns_si(&rows->columns, g->first), span_s,
                        unless_simulated(g->first, raw->v[g->first][i]));
  }
  const bool sensor = g->first >= SIG_AX && g->first <= SIG_GZ;
  if (!sensor || whole < raw->n - 1 || raw->n < RUN_ROWS) return DONE;
  return table_refuse(&rows->table, raw->line[0], rows->at[g->first], why,
                      "stands at %.6g %s from the first row to the last; is the sensor stuck?",
                      raw->v[g->first][0], columns_si(&rows->columns, g->first));
}

static bool zero_throughout(const raw_t *raw, signal_id_t signal) {
  for (int i = 0; raw->v[signal] && i < raw->n; i++)
    if (!(raw->v[signal][i] == 0.0)) return false;
  return true;
}

// True for a simulated flight along the vertical axis: no stuck sensor leaves all of these signals at zero.
static bool on_vertical_axis(const raw_t *raw) {
  static const signal_id_t beside[] = {SIG_QX, SIG_QY, SIG_QZ, SIG_AX, SIG_AY, SIG_VX, SIG_VY};
  for (unsigned i = 0; i < sizeof beside / sizeof *beside; i++)
    if (!zero_throughout(raw, beside[i])) return false;
  return raw->v[SIG_AX] && raw->v[SIG_AY] && raw->v[SIG_AZ];
}

done_t raw_check_stuck(const raw_t *raw, const log_rows_t *rows, why_t *why) {
  const bool vertical = on_vertical_axis(raw);
  for (int i = 0; i < N_GROUP; i++) {
    if (rows->columns.of[GROUP[i].first].constant) continue;
    const bool beside = GROUP[i].first != SIG_AZ && GROUP[i].first != SIG_M1 && GROUP[i].first != SIG_W1;
    if (logged(raw, GROUP[i].first, GROUP[i].n) && !(vertical && beside))
      TRY(check_group(raw, rows, &GROUP[i], why));
  }
  return DONE;
}
