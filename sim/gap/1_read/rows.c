// rows.c - stage 1: reads the rows of a log into memory, thinned and merged.
#include "gap/1_read/read.h"

#include "base/by_size.h"
#include <math.h>
#include <stdlib.h>

#define FIRST       512  // rows from which the rate is estimated
#define BUNCH       0.25 // rows closer than this share of the median period came late, together
#define RATE_MIN_HZ 40.0
#define RATE_MAX_HZ 2200.0
#define NO_RETURN_M 32.0 // sensors read 32.766 or 32.767 m where nothing comes back

// Sums for the mean of rows that are merged or thinned into one.
typedef struct {
  int rows, n[SIG_COUNT];
  double first_s, sum_s, sum[SIG_COUNT];
  bool at_limit;
  long line;
} bin_t;

typedef struct {
  log_row_t row;
  long line;
} early_t;

static const signals_t RANGES = SIGNALS(SIG_RANGE, SIG_RANGE_DOWN);

void raw_drop(raw_t *raw, signal_id_t signal) {
  free(raw->v[signal]);
  raw->v[signal] = NULL;
}

void raw_free(raw_t *raw) {
  for (int i = 0; i < SIG_COUNT; i++) raw_drop(raw, (signal_id_t)i);
  free(raw->t_s);
  free(raw->at_limit);
  free(raw->line);
  *raw = (raw_t){0};
}

static bool grow(void **array, size_t room, size_t size) {
  void *const more = realloc(*array, room * size);
  if (more) *array = more;
  return more != NULL;
}

static bool raw_grow(raw_t *raw, signals_t has) {
  if (raw->n < raw->room) return true;
  const size_t room = raw->room ? (size_t)raw->room * 3 / 2 : 8192;
  bool good = grow((void **)&raw->t_s, room, sizeof(double)) &&
              grow((void **)&raw->at_limit, room, sizeof(bool)) &&
              grow((void **)&raw->line, room, sizeof(long));
  for (int i = 0; good && i < SIG_COUNT; i++)
    if (has & SIGNAL_BIT(i)) good = grow((void **)&raw->v[i], room, sizeof(double));
  if (good) raw->room = (int)room;
  return good;
}

static done_t bin_close(bin_t *b, raw_t *raw, signals_t has, why_t *why) {
  if (b->rows == 0) return DONE;
  if (!raw_grow(raw, has)) return error_failed(why, "out of memory at %d rows", raw->n);
  raw->t_s[raw->n] = b->sum_s / b->rows;
  raw->at_limit[raw->n] = b->at_limit;
  raw->line[raw->n] = b->line;
  for (int i = 0; i < SIG_COUNT; i++)
    if (raw->v[i]) raw->v[i][raw->n] = b->n[i] ? b->sum[i] / b->n[i] : (double)NAN;
  raw->n++;
  *b = (bin_t){0};
  return DONE;
}

static done_t bin_add(bin_t *b, raw_t *raw, const early_t *e, signals_t has, why_t *why) {
  const double *const v = e->row.v, t_s = v[SIG_TIME];
  const bool bunched = b->rows > 0 && t_s - b->sum_s / b->rows < BUNCH * raw->period_s;
  if (!bunched && b->rows >= raw->thin) TRY(bin_close(b, raw, has, why));
  if (bunched) raw->merged++;
  if (b->rows == 0) {
    b->first_s = t_s;
    b->line = e->line;
  }
  b->rows++;
  b->sum_s += t_s;
  b->at_limit = b->at_limit || e->row.at_limit;
  for (int i = 0; i < SIG_COUNT; i++) {
    if (isnan(v[i])) continue;
    const bool newest = RANGES & SIGNAL_BIT(i);
    b->sum[i] = newest ? v[i] : b->sum[i] + v[i];
    b->n[i] = newest ? 1 : b->n[i] + 1;
  }
  return DONE;
}

static done_t tell_rate(raw_t *raw, const early_t *early, int n, const log_rows_t *rows, why_t *why) {
  double dt_s[FIRST];
  for (int i = 1; i < n; i++) dt_s[i - 1] = early[i].row.v[SIG_TIME] - early[i - 1].row.v[SIG_TIME];
  if (n < 3) return table_refuse(&rows->table, 0, -1, why, "%d rows; allowed: a flight", n);
  qsort(dt_s, (size_t)n - 1, sizeof *dt_s, by_size);
  raw->period_s = dt_s[(n - 1) / 2];
  const double min_s = 1.0 / RATE_MAX_HZ, max_s = 1.0 / RATE_MIN_HZ;
  if (!(raw->period_s >= min_s && raw->period_s <= max_s)) {
    char hint[COLUMNS_HINT];
    columns_hint(&rows->columns, SIG_TIME, raw->period_s, min_s, max_s, hint);
    return table_refuse(&rows->table, 0, rows->at[SIG_TIME], why,
                        "rows are apart by %.3g s; allowed: %.2g to %.2g s%s", raw->period_s, min_s, max_s,
                        hint);
  }
  raw->thin = (int)(1.0 / (raw->period_s * GAP_RATE_HZ) + 0.25);
  if (raw->thin < 1) raw->thin = 1;
  return DONE;
}

// Keeps only new samples: a sensor slower than the log repeats its value there, or leaves gaps. A cell of 0,
// which reads as the columns file's mounting offset, is no distance; with an offset, a distance may be
// slightly negative.
static void keep_new_ranges(raw_t *raw, const columns_t *columns, double *v, double last_m[2]) {
  static const signal_id_t range[2] = {SIG_RANGE, SIG_RANGE_DOWN};
  for (int k = 0; k < 2; k++) {
    double *const now_m = &v[range[k]];
    const bool repeat = *now_m == last_m[k];
    if (isnan(*now_m)) continue; // the last value stays: rows of other events may lie between
    last_m[k] = *now_m;
    if (repeat) {
      *now_m = (double)NAN;
    } else if (*now_m == columns->of[range[k]].offset || !(*now_m < NO_RETURN_M)) {
      raw->range_unusable++;
      *now_m = (double)NAN;
    }
  }
}

typedef struct {
  early_t early[FIRST + 1];
  int n; // rows in `early`; once there are FIRST of them, the rate is estimated
  bin_t bin;
} row_reader_t;

// Estimates the rate, once, and takes the rows that waited for it.
static done_t begin(row_reader_t *r, raw_t *raw, const log_rows_t *rows, why_t *why) {
  if (raw->thin > 0) return DONE;
  TRY(tell_rate(raw, r->early, r->n, rows, why));
  for (int i = 0; i < r->n; i++) TRY(bin_add(&r->bin, raw, &r->early[i], rows->has, why));
  return DONE;
}

static done_t read_all(row_reader_t *r, raw_t *raw, log_rows_t *rows, bool *cut, why_t *why) {
  double last_m[2] = {(double)NAN, (double)NAN};
  for (;;) {
    early_t *const e = &r->early[r->n];
    bool more;
    TRY(log_rows_next(rows, &e->row, &more, why));
    if (!more) break;
    e->line = table_line(&rows->table);
    keep_new_ranges(raw, &rows->columns, e->row.v, last_m);
    *cut = e != r->early && e->row.v[SIG_TIME] - r->early[0].row.v[SIG_TIME] > GAP_FLIGHT_S;
    if (*cut) break;
    raw->rows++;
    if (r->n < FIRST) {
      r->n++;
      continue;
    }
    TRY(begin(r, raw, rows, why));
    TRY(bin_add(&r->bin, raw, e, rows->has, why));
  }
  TRY(begin(r, raw, rows, why));
  return bin_close(&r->bin, raw, rows->has, why);
}

done_t raw_read(raw_t *raw, log_rows_t *rows, bool *cut, why_t *why) {
  *cut = false;
  row_reader_t *const reader = calloc(1, sizeof *reader);
  if (!reader) return error_failed(why, "out of memory");
  const done_t status = read_all(reader, raw, rows, cut, why);
  free(reader);
  return status;
}
