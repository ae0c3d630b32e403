// stirs.c - covariances of a residual over the quieter half of a set.
#include "gap/3_feedback/stirs.h"

#include "base/nth.h"
#include <math.h>
#include <stdlib.h>

#define LEVEL_CHANGES 4 // what begins within a stretch is in two changes, and the median passes over it

enum { STRETCH_BLOCKS = 2 }; // 4 s: a vehicle takes seconds to pass through something, and a gust less

// One stretch, about its mean.
typedef struct {
  double of[STIRS_LAGS];
  double changes, pairs; // sum of squares of the changes from row to row, and their number
  double slow;           // sum of the products from STIRS_SLOW on, per row
  double mean;
  int rows, flight;
} stretch_t;

// Returns the end of the stretch that begins with row `from`.
static int stretch_end(const rows_t *r, int from) {
  int end = from;
  while (end < r->n && r->flight[end] == r->flight[from] && r->block[end] < r->block[from] + STRETCH_BLOCKS)
    end++;
  return end;
}

static stretch_t stretch_of(const rows_t *r, const double *v, int from, int end) {
  stretch_t s = {.rows = end - from, .flight = r->flight[from]};
  for (int i = from; i < end; i++) s.mean += v[i] / (end - from);
  for (int i = from, first = from; i < end; i++) {
    if (!r->follows[i]) first = i;
    for (int lag = 0; lag < STIRS_LAGS && i - lag >= first; lag++)
      s.of[lag] += (v[i] - s.mean) * (v[i - lag] - s.mean);
    if (i == first) continue;
    s.changes += (v[i] - v[i - 1]) * (v[i] - v[i - 1]);
    s.pairs += 1.0;
  }
  for (int lag = STIRS_SLOW; lag < STIRS_LAGS; lag++) s.slow += s.of[lag] / (end - from);
  return s;
}

// Returns the mean square of the stretches' means about each other: of what is new in each, half the square
// of a change from one to the next. Leaves `room` in another order.
static double level_of(const stretch_t *stretch, int n, double *room) {
  int changes = 0;
  for (int k = 1; k < n; k++)
    if (stretch[k].flight == stretch[k - 1].flight)
      room[changes++] = fabs(stretch[k].mean - stretch[k - 1].mean);
  if (changes < LEVEL_CHANGES) return 0.0;
  const double change = nth_smallest(room, changes, (changes - 1) / 2) / NTH_NORMAL_MEDIAN;
  return 0.5 * change * change;
}

done_t stirs_add(stirs_t *sum, const set_t *s, const double *v, why_t *why) {
  const rows_t *const r = &s->smooth;
  const size_t room = (size_t)s->n_block + 1;
  stretch_t *const stretch = malloc(room * sizeof *stretch);
  double *const slow = malloc(room * sizeof *slow), squares = 0.0, pairs = 0.0;
  int n = 0;
  for (int from = 0, end; stretch && slow && from < r->n; from = end, n++) {
    end = stretch_end(r, from);
    stretch[n] = stretch_of(r, v, from, end);
    slow[n] = stretch[n].slow;
  }
  const double most = n ? nth_smallest(slow, n, (n - 1) / 2) : 0.0;
  for (int k = 0; k < n; k++) {
    if (stretch[k].slow > most) continue;
    for (int lag = 0; lag < STIRS_LAGS; lag++) sum->lag[lag] += stretch[k].of[lag] / r->n;
    squares += stretch[k].changes;
    pairs += stretch[k].pairs;
    sum->share += (double)stretch[k].rows / r->n;
  }
  sum->changes += pairs > 0.0 ? 0.5 * squares / pairs : 0.0;
  const bool good = stretch && slow;
  if (good) sum->level += level_of(stretch, n, slow);
  free(stretch);
  free(slow);
  return good ? DONE : error_failed(why, "out of memory");
}
