// flight_log.c - a recorded flight on a 100 Hz grid.
#include "logs/flight_log.h"

#include "logs/log_sanity.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MEAN_FROM   3    // rows per tick from which their mean is taken
#define SAME_TIME_S 1e-6 // decimals in a file are not exact

struct flight_log {
  log_rows_t rows;
  signals_t need;
  log_sanity_t sanity;
  flight_log_count_t count;
  log_row_t before, after; // the rows around the tick: before <= tick < after
  bool any_before, any_after;
  double start_s;        // of this grid
  long k;                // number of the tick in it
  double sum[SIG_COUNT]; // over the rows of the tick's period
  int n;
  bool at_limit, range_new;
  double range_m;   // the newest
  double command_N; // at the last tick
};

done_t flight_log_open(flight_log_t **log, const char *path, const columns_t *columns, const model_t *vehicle,
                       signals_t need, why_t *why) {
  *log = NULL;
  flight_log_t *const fresh = calloc(1, sizeof *fresh);
  if (!fresh) return error_failed(why, "%s: out of memory", path);
  fresh->need = need;
  fresh->range_m = (double)NAN;
  const done_t status = log_rows_open(&fresh->rows, path, columns, vehicle, LOG_STRICT, need, why);
  if (status == DONE)
    *log = fresh;
  else
    free(fresh);
  return status;
}

void flight_log_close(flight_log_t *log) {
  if (!log) return;
  log_rows_close(&log->rows);
  free(log);
}

flight_log_count_t flight_log_count(const flight_log_t *log) {
  return log->count;
}

long flight_log_bad(const flight_log_t *log, why_t *first) {
  return log_rows_bad(&log->rows, first);
}

bool flight_log_has(const flight_log_t *log, signal_id_t signal) {
  return log->rows.has & SIGNAL_BIT(signal);
}

static bool complete(const flight_log_t *log, const log_row_t *row) {
  for (int i = 0; i < SIG_COUNT; i++)
    if ((log->need & SIGNAL_BIT(i)) && isnan(row->v[i])) return false;
  return true;
}

// Takes a new sample of the range. A log that is faster than the sensor (10 Hz) repeats it or has gaps
// between.
static void take_range(flight_log_t *log, const log_row_t *row) {
  const double range_m = row->v[SIG_RANGE];
  if (isnan(range_m) || range_m == log->range_m) return;
  log->range_m = range_m;
  log->range_new = true;
}

// Reads the next complete row into `after`.
static done_t read_after(flight_log_t *log, why_t *why) {
  for (;;) {
    TRY(log_rows_next(&log->rows, &log->after, &log->any_after, why));
    if (!log->any_after) return DONE;
    log->count.rows++;
    log_sanity_add(&log->sanity, &log->after);
    if (complete(log, &log->after)) return DONE;
    log->count.gaps++;
    take_range(log, &log->after);
  }
}

static done_t check_all(const flight_log_t *log, why_t *why) {
  TRY(log_rows_check_cells(&log->rows, log->count.rows, why));
  return log_sanity_check(&log->sanity, &log->rows, why);
}

// `after` belongs to the tick's period: it becomes `before`.
static done_t take_row(flight_log_t *log, why_t *why) {
  log->before = log->after;
  log->any_before = true;
  for (int i = 0; i < SIG_COUNT; i++) log->sum[i] += log->before.v[i];
  log->n++;
  log->at_limit = log->at_limit || log->before.at_limit;
  take_range(log, &log->before);
  return read_after(log, why);
}

static void start_period(flight_log_t *log) {
  memset(log->sum, 0, sizeof log->sum);
  log->n = 0;
  log->at_limit = log->range_new = false;
}

static void interpolate(const flight_log_t *log, double t_s, double v[SIG_COUNT]) {
  const double *a = log->before.v, *b = log->after.v;
  const double span_s = b[SIG_TIME] - a[SIG_TIME];
  const double share = log->any_after ? (t_s - a[SIG_TIME]) / span_s : 0.0;
  for (int i = 0; i < SIG_COUNT; i++) v[i] = log->any_after ? a[i] + share * (b[i] - a[i]) : a[i];
}

static void unit_quaternion(double *q) {
  const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; i++) q[i] /= norm;
}

static void fill(flight_log_t *log, flight_tick_t *tick, double t_s) {
  tick->split = log->k == 0;
  const bool mean = log->n >= MEAN_FROM;
  if (mean)
    for (int i = 0; i < SIG_COUNT; i++) tick->v[i] = log->sum[i] / log->n;
  else
    interpolate(log, t_s, tick->v);
  unit_quaternion(&tick->v[SIG_QW]);
  tick->v[SIG_TIME] = t_s;
  tick->v[SIG_RANGE] = log->range_m;
  // The command in a row acts from then on; the mean over a period is what acted in it.
  tick->applied_N = mean || tick->split ? tick->v[SIG_THRUST] : log->command_N;
  log->command_N = tick->v[SIG_THRUST];
  tick->at_limit = log->at_limit;
  tick->range_new = log->range_new;
}

// True at the grid's end: a gap or the end of the file follows, and no row lies at or after the tick.
static bool grid_ends(const flight_log_t *log, double t_s) {
  if (!log->any_before) return true;
  const double at_s = log->before.v[SIG_TIME];
  if (log->any_after && log->after.v[SIG_TIME] - at_s <= LOG_GAP_S) return false;
  return t_s > at_s + SAME_TIME_S;
}

done_t flight_log_next(flight_log_t *log, flight_tick_t *tick, bool *more, why_t *why) {
  *more = false;
  if (log->count.rows == 0) TRY(read_after(log, why));
  start_period(log);
  double t_s = log->start_s + FLIGHT_LOG_PERIOD_S * (double)log->k;
  while (log->any_before && log->any_after && log->after.v[SIG_TIME] <= t_s + SAME_TIME_S &&
         log->after.v[SIG_TIME] - log->before.v[SIG_TIME] <= LOG_GAP_S)
    TRY(take_row(log, why));
  if (grid_ends(log, t_s)) {
    if (!log->any_after) return check_all(log, why);
    t_s = log->start_s = log->after.v[SIG_TIME];
    log->k = 0;
    log->count.splits += log->any_before;
    TRY(take_row(log, why));
  }
  fill(log, tick, t_s);
  log->k++;
  log->count.ticks++;
  *more = true;
  return DONE;
}
