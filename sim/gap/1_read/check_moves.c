// check_moves.c - stage 1: checks the units of ranges and set points by how far they and the position move.
//
// Objects under or above a vehicle move a range, too, and a vehicle follows its set points late. So a stream
// is refused only where it and the position lie on a line and another known unit makes their movements equal.
#include "gap/1_read/read.h"

#include <math.h>

#define APART_S   0.5  // least time between compared samples of a range: an age of 0.1 s then matters little
#define MOVES_M   0.05 // least movement that counts, and least rms of the movements
#define MOVES_MIN 10   // least number of movements
#define TOGETHER  0.8  // least share of the squares that a line explains
#define ALIKE     1.25 // movements within this factor are equal

typedef struct {
  double n, x, y, xx, xy, yy;
} line_t;

static void add(line_t *s, double x, double y) {
  s->n += 1.0;
  s->x += x, s->y += y;
  s->xx += x * x, s->xy += x * y, s->yy += y * y;
}

// Returns the slope of y against x; NaN: they do not lie on a line, or x moves too little.
static double slope(const line_t *s) {
  const double xx = s->xx - s->x * s->x / s->n, xy = s->xy - s->x * s->y / s->n,
               yy = s->yy - s->y * s->y / s->n;
  if (!(s->n >= MOVES_MIN && xx >= s->n * MOVES_M * MOVES_M)) return (double)NAN;
  return xy > 0.0 && xy * xy >= TOGETHER * xx * yy ? xy / xx : (double)NAN;
}

// Refuses a stream that moves `times` as far as the position, if another unit makes the two equal.
static done_t judge(const log_rows_t *rows, signal_id_t stream, const char *what, int axis, double times,
                    why_t *why) {
  char text[COLUMNS_HINT];
  if (!(times < SLOPE_MIN || times > SLOPE_MAX)) return DONE; // NaN, too
  if (!columns_hint(&rows->columns, stream, times, 1.0 / ALIKE, ALIKE, text)[0]) return DONE;
  return table_refuse(&rows->table, 0, rows->at[stream], why,
                      "the %s moves %.3g times as far as the place along axis %c over the whole flight; "
                      "allowed: 0.33 to 3%s",
                      what, times, 'x' + axis, text);
}

// Compares changes between samples APART_S or more apart. The upward range falls as the vehicle rises.
static done_t check_range_moves(const gap_flight_t *f, const log_rows_t *rows, signal_id_t range,
                                why_t *why) {
  const double sign = range == SIG_RANGE ? -1.0 : 1.0, *const v = f->v[range], *const z_m = f->v[SIG_Z];
  line_t line = {0};
  int last = -1;
  if (!v || !z_m) return DONE;
  for (int i = 0; i < f->n; i++) {
    if (isnan(v[i]) || isnan(z_m[i])) continue;
    const bool first = last < 0 || f->segment[last] != f->segment[i];
    if (!first && f->t_s[i] - f->t_s[last] < APART_S) continue;
    const double rise_m = first ? 0.0 : sign * (z_m[i] - z_m[last]);
    if (fabs(rise_m) >= MOVES_M) add(&line, rise_m, v[i] - v[last]);
    last = i;
  }
  return judge(rows, range, "range", 2, slope(&line), why);
}

// Compares values over the whole flight, not single movements, because a position follows its set point late.
static done_t check_set_point(const gap_flight_t *f, const log_rows_t *rows, int axis, why_t *why) {
  const double *const set_m = f->v[SIG_SET_X + axis], *const at_m = f->v[SIG_X + axis];
  line_t line = {0};
  if (!set_m || !at_m) return DONE;
  for (int i = 0; i < f->n; i++)
    if (!isnan(set_m[i]) && !isnan(at_m[i])) add(&line, at_m[i], set_m[i]);
  return judge(rows, (signal_id_t)(SIG_SET_X + axis), "set point", axis, slope(&line), why);
}

done_t gap_check_moves(const gap_flight_t *f, const log_rows_t *rows, why_t *why) {
  TRY(check_range_moves(f, rows, SIG_RANGE, why));
  TRY(check_range_moves(f, rows, SIG_RANGE_DOWN, why));
  for (int axis = 0; axis < 3; axis++) TRY(check_set_point(f, rows, axis, why));
  return DONE;
}
