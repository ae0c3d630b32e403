// 1_read.c - a log into memory, in SI and our frames.
#include "gap/flight.h"
#include "io/log_rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GAP_S 0.15

static status_t add(gap_flight_t *f, int *room, const log_row_t *row, unsigned has, why_t *why) {
  if (f->n == *room) {
    *room = *room ? 2 * *room : 4096;
    for (int i = 0; i < SIG_COUNT; i++) {
      if (!(has & SIGNAL_BIT(i))) continue;
      double *const bigger = realloc(f->v[i], (size_t)*room * sizeof(double));
      if (!bigger) return error_failed(why, "out of memory");
      f->v[i] = bigger;
    }
    bool *const saturated = realloc(f->saturated, (size_t)*room * sizeof(bool));
    if (saturated) f->saturated = saturated;
    int *const segment = realloc(f->segment, (size_t)*room * sizeof(int));
    if (segment) f->segment = segment;
    if (!saturated || !segment) return error_failed(why, "out of memory");
  }
  for (int i = 0; i < SIG_COUNT; i++)
    if (has & SIGNAL_BIT(i)) f->v[i][f->n] = row->v[i];
  const int n = f->n++;
  f->saturated[n] = row->at_limit;
  f->segment[n] = n == 0 ? 0 : f->segment[n - 1] + (f->v[SIG_TIME][n] - f->v[SIG_TIME][n - 1] > GAP_S);
  return ST_OK;
}

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static status_t finish(gap_flight_t *f, double rest_m, why_t *why) {
  if (f->n < 2) return error_set(why, "%s: %d rows; needed: a flight", f->name, f->n);
  f->t_s = f->v[SIG_TIME];
  f->v[SIG_TIME] = NULL;
  double *const span = malloc((size_t)f->n * sizeof(double));
  if (!span) return error_failed(why, "out of memory");
  for (int i = 1; i < f->n; i++) span[i] = f->t_s[i] - f->t_s[i - 1];
  qsort(span + 1, (size_t)f->n - 1, sizeof(double), by_size);
  f->rate_Hz = 1.0 / span[1 + (f->n - 1) / 2];
  free(span);
  for (int i = 0; f->v[SIG_Z] && isfinite(rest_m) && i < f->n; i++) f->v[SIG_Z][i] -= rest_m;
  double *const range = f->v[SIG_RANGE];
  if (!range) return ST_OK;
  f->range_up_m = range;
  f->v[SIG_RANGE] = NULL;
  double last = (double)NAN;
  for (int i = 0; i < f->n; i++) {
    const double now = range[i];
    if (now == last || !(now > 0.0)) range[i] = (double)NAN;
    last = now;
  }
  return ST_OK;
}

static status_t read_rows(gap_flight_t *f, log_rows_t *rows, why_t *why) {
  int room = 0;
  for (;;) {
    log_row_t row;
    bool more;
    TRY(log_rows_next(rows, &row, &more, why));
    if (!more) return ST_OK;
    TRY(add(f, &room, &row, rows->has, why));
  }
}

status_t gap_read(gap_flight_t *f, const char *path, const columns_t *columns, const model_t *vehicle,
                  why_t *why) {
  log_rows_t rows;
  *f = (gap_flight_t){.motors_N = columns->motors_N};
  snprintf(f->name, sizeof f->name, "%s", path);
  TRY(log_rows_open(&rows, path, columns, vehicle, SIGNAL_BIT(SIG_TIME), why));
  status_t status = read_rows(f, &rows, why);
  log_rows_close(&rows);
  if (status == ST_OK) status = finish(f, columns->rest_height_m, why);
  if (status != ST_OK) gap_flight_free(f);
  return status;
}

void gap_flight_free(gap_flight_t *f) {
  for (int i = 0; i < SIG_COUNT; i++) free(f->v[i]);
  for (int i = 0; i < 4; i++) free(f->motor_speed_radps[i]);
  free(f->t_s);
  free(f->range_up_m);
  free(f->range_down_m);
  free(f->saturated);
  free(f->segment);
  *f = (gap_flight_t){.n = 0};
}
