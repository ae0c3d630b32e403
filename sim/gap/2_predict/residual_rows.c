// residual_rows.c - a series by point, through the zero-phase low-pass, as rows.
#include "gap/2_predict/residual.h"

#include "base/lowpass.h"
#include "base/pair.h"
#include <math.h>

#define TINY  1e-140
#define PAIRS (CH_SMOOTH / 2)

// --- the filter -------------------------------------------------------------------------------------------

// A number that is almost nothing is nothing: what dies away in the filter would end where processors are
// slow. One comparison: of two, joined, a compiler for SSE2 makes a way through four other registers.
static inline pair_t not_tiny(pair_t y) {
  const pair_t size = (pair_t)((pair_bits_t)y & INT64_MAX);
  return (pair_t)((size > TINY) & (pair_bits_t)y);
}

// Forwards and backwards; every segment starts at rest. v: 2 * pairs numbers of every point, all at once: one
// alone would wait for itself.
static inline void smooth(const grid_t *g, int pairs, double *v) {
  pair_t x1[PAIRS] = {{0.0}}, x2[PAIRS] = {{0.0}}, y1[PAIRS] = {{0.0}}, y2[PAIRS] = {{0.0}};
  lowpass_t f;
  lowpass_init(&f, fmin(RESIDUAL_SMOOTH_HZ, 0.4 / g->period_s), 1.0 / g->period_s, 0.0);
  for (int way = 1; way >= -1; way -= 2) {
    const int rest = way > 0 ? MARK_FIRST : MARK_LAST;
    for (int j = way > 0 ? 0 : g->n - 1; j >= 0 && j < g->n; j += way) {
      double *const at = v + 2 * pairs * j;
      const bool starts = g->mark[j] & rest;
      for (int k = 0; k < pairs; k++) {
        const pair_t x = pair_of(at + 2 * k);
        if (starts) x1[k] = x2[k] = y1[k] = y2[k] = x;
        const pair_t y = not_tiny(f.b * (x + 2.0 * x1[k] + x2[k]) - f.a1 * y1[k] - f.a2 * y2[k]);
        x2[k] = x1[k], x1[k] = x;
        y2[k] = y1[k], y1[k] = y;
        pair_put(at + 2 * k, y);
      }
    }
  }
}

// With numbers that the compiler knows, everything stays in registers.
static void smooth_all(const grid_t *g, int pairs, double *v) {
  if (pairs == 1) smooth(g, 1, v);
  if (pairs == 2) smooth(g, 2, v);
  if (pairs == 3) smooth(g, 3, v);
}

// --- rows -------------------------------------------------------------------------------------------------

static double differentiated(const grid_t *g, const double *v, int j) {
  const double next = g->mark[j] & MARK_LAST ? v[j] : v[j + 1];
  const double before = g->mark[j] & MARK_FIRST ? v[j] : v[j - 1];
  return (next - before) / (2.0 * g->period_s);
}

// The mean over the way from the point before to the point after: what a difference of the two sees.
static double over_two(const grid_t *g, const double *v, int j) {
  const double next = g->mark[j] & MARK_LAST ? v[j] : v[j + 1];
  const double before = g->mark[j] & MARK_FIRST ? v[j] : v[j - 1];
  return (before + 4.0 * v[j] + next) / 6.0;
}

// One channel to every `apart`-th number of `to`. What is masked does not spill over through the filter: the
// last value stands in for it.
static void take(const grid_t *g, int channel, series_t kind, const double *series, double *to, int apart) {
  const int is_free = channel < CH_FORCES ? MARK_FREE : MARK_TURN_FREE;
  double last = 0.0;
  for (int j = 0; j < g->n; j++) {
    const bool plain = channel < CH_FORCES && (kind == SERIES_RATE || !g->acceleration_made);
    const double x = plain                      ? series[j]
                     : kind == SERIES_PREDICTED ? over_two(g, series, j)
                                                : differentiated(g, series, j);
    if (isfinite(x) && (g->mark[j] & is_free)) last = x;
    to[apart * j] = last;
  }
}

// Rows of a flight from every `apart`-th number.
static void pick(const rows_t *r, int flight, const double *from, int apart, double *row) {
  const int end = rows_from(r, flight + 1);
  for (int i = rows_from(r, flight); i < end; i++) row[i] = from[apart * r->point[i]];
}

void residual_rows(const set_t *s, int flight, series_t kind, const double *const series[CHANNELS],
                   double *scratch, double *const row[CHANNELS]) {
  const grid_t *g = &s->grid[flight];
  int n = 0, wanted[CH_SMOOTH];
  for (int ch = 0; ch < CH_SMOOTH; ch++)
    if (row[ch]) wanted[n++] = ch;
  const int pairs = (n + 1) / 2;
  for (int i = 0; i < n; i++) take(g, wanted[i], kind, series[wanted[i]], scratch + i, 2 * pairs);
  for (int j = 0; n % 2 && j < g->n; j++) scratch[2 * pairs * j + n] = 0.0;
  smooth_all(g, pairs, scratch);
  for (int i = 0; i < n; i++) pick(&s->smooth, flight, scratch + i, 2 * pairs, row[wanted[i]]);
  if (row[CH_RANGE]) pick(&s->range, flight, series[CH_RANGE], 1, row[CH_RANGE]);
}
