// residual_rows.c - filters series of points by the zero-phase low-pass, and takes rows from them.
#include "gap/2_predict/residual.h"

#include "base/lowpass.h"
#include "base/wide.h"
#include <math.h>

#define TINY 1e-140

_Static_assert(CH_SMOOTH <= WIDE && (int)RESIDUAL_SCRATCH == WIDE,
               "all channels of a point are filtered at once");

// --- the filter -------------------------------------------------------------------------------------------

// Points that are filtered between two checks for numbers that are almost 0.
#define CHUNK 32

typedef struct {
  four_t x1, x2, y1, y2;
} rest_t;

// Filters four numbers of a point, in place. tidy: those that are almost 0 become 0; else `met` notes them.
WIDE_INLINE void filter_four(const lowpass_t *f, bool starts, bool tidy, double *v, rest_t *s,
                             four_bits_t *met) {
  four_t x;
  FOUR_LOAD(x, v);
  if (starts) s->x1 = s->x2 = s->y1 = s->y2 = x;
  four_t y = f->b * (x + 2.0 * s->x1 + s->x2) - f->a1 * s->y1 - f->a2 * s->y2;
  const four_bits_t size = (four_bits_t)y & INT64_MAX, tiny = (four_t)size <= TINY;
  if (tidy)
    y = (four_t)(~tiny & (four_bits_t)y);
  else
    *met |= tiny & size;
  s->x2 = s->x1, s->x1 = x;
  s->y2 = s->y1, s->y1 = y;
  FOUR_PUT(v, y);
}

// Filters n points from j on, in place. Numbers that are almost 0 have to become 0, because what decays in
// the filter would end as denormal numbers, with which processors are slow. tidy: they are made 0. Else:
// returns whether there were any.
WIDE_INLINE bool filter(const lowpass_t *f, const unsigned char *mark, int starts, int j, int n, int way,
                        bool tidy, double *v, rest_t s[HALVES]) {
  rest_t low = s[0], high = s[1];
  four_bits_t met = {0};
  for (; n > 0; n--, j += way) {
    filter_four(f, mark[j] & starts, tidy, v + WIDE * j, &low, &met);
    filter_four(f, mark[j] & starts, tidy, v + WIDE * j + HALF, &high, &met);
  }
  s[0] = low, s[1] = high;
  return (met[0] | met[1] | met[2] | met[3]) != 0;
}

// Filters forwards and backwards; every segment starts at rest. v: WIDE numbers of every point, filtered at
// once, because each step of a single one would wait for the step before.
WIDE_COPIES static void smooth(const lowpass_t *f, const unsigned char *mark, int n, double *v) {
  double before[WIDE * CHUNK];
  for (int way = 1; way >= -1; way -= 2) {
    const int starts = way > 0 ? MARK_FIRST : MARK_LAST;
    rest_t s[HALVES] = {{.x1 = {0.0}}};
    for (int done = 0; done < n; done += CHUNK) {
      const int points = n - done < CHUNK ? n - done : CHUNK, j = way > 0 ? done : n - 1 - done;
      double *const low = v + WIDE * (way > 0 ? j : j - points + 1);
      const rest_t begin[HALVES] = {s[0], s[1]};
      memcpy(before, low, (size_t)points * WIDE * sizeof(double));
      if (!filter(f, mark, starts, j, points, way, false, v, s)) continue;
      memcpy(low, before, (size_t)points * WIDE * sizeof(double));
      memcpy(s, begin, sizeof s);
      (void)filter(f, mark, starts, j, points, way, true, v, s);
    }
  }
}

// --- rows -------------------------------------------------------------------------------------------------

// What to take of a point and its neighbours (at the end of a segment the point itself replaces one): the
// value; its rate of change; its mean from the point before to the point after, as in a difference.
typedef enum { TAKE_SELF, TAKE_CHANGE, TAKE_MEAN } take_t;

WIDE_INLINE double taken(take_t what, double before, double here, double next, double span_s) {
  return what == TAKE_SELF     ? here
         : what == TAKE_CHANGE ? (next - before) / span_s
                               : (before + 4.0 * here + next) / 6.0;
}

// The last value stands in for one that is masked, so that this does not spill over through the filter.
WIDE_INLINE double take_one(const grid_t *g, take_t what, int is_free, const double *v, int j, double last) {
  const double next = g->mark[j] & MARK_LAST ? v[j] : v[j + 1];
  const double before = g->mark[j] & MARK_FIRST ? v[j] : v[j - 1];
  const double x = taken(what, before, v[j], next, 2.0 * g->period_s);
  return isfinite(x) && (g->mark[j] & is_free) ? x : last;
}

// True if all of the next eight points are free, and none is at the end of a segment.
WIDE_INLINE bool all_plain(const unsigned char *mark, int is_free) {
  uint64_t marks;
  memcpy(&marks, mark, sizeof marks);
  const uint64_t each = 0x0101010101010101u;
  return (marks & each * (uint64_t)(is_free | MARK_FIRST | MARK_LAST)) == each * (uint64_t)is_free;
}

// Takes the points from..to-1. last: the last good value, before them and then after them.
WIDE_INLINE void take_some(const grid_t *g, take_t what, int is_free, int from, int to, const double *v,
                           double *out, double *last) {
  for (int j = from; j < to;) {
    if (j + WIDE <= to && all_plain(g->mark + j, is_free)) {
      double x[WIDE], nothing = 0.0; // NaN where one of them is not finite
      for (int k = 0; k < WIDE; k++)
        x[k] = what == TAKE_SELF ? v[j + k]
                                 : taken(what, v[j + k - 1], v[j + k], v[j + k + 1], 2.0 * g->period_s);
      for (int k = 0; k < WIDE; k++) nothing += 0.0 * x[k];
      if (!isnan(nothing)) {
        for (int k = 0; k < WIDE; k++) out[WIDE * (j + k)] = x[k];
        *last = x[WIDE - 1];
        j += WIDE;
        continue;
      }
    }
    const int end = j + WIDE < to ? j + WIDE : to;
    for (; j < end; j++) out[WIDE * j] = *last = take_one(g, what, is_free, v, j, *last);
  }
}

// Takes n channels, each into every eighth number of `out`. A few points of each channel are done in turn,
// because the channels lie side by side there.
WIDE_COPIES static void take(const grid_t *g, series_t kind, int n, const int *channel,
                             const double *const *series, double *out) {
  double last[CH_SMOOTH] = {0.0};
  for (int from = 0; from < g->n; from += CHUNK)
    for (int i = 0; i < n; i++) {
      const int to = from + CHUNK < g->n ? from + CHUNK : g->n;
      const bool force = channel[i] < CH_FORCES;
      const double *const v = series[channel[i]];
      if (force && (kind == SERIES_RATE || !g->acceleration_made))
        take_some(g, TAKE_SELF, MARK_FREE, from, to, v, out + i, &last[i]);
      else if (kind == SERIES_PREDICTED)
        take_some(g, TAKE_MEAN, force ? MARK_FREE : MARK_TURN_FREE, from, to, v, out + i, &last[i]);
      else
        take_some(g, TAKE_CHANGE, force ? MARK_FREE : MARK_TURN_FREE, from, to, v, out + i, &last[i]);
    }
}

// Picks a flight's rows out of `from`, where points are `apart` numbers apart.
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
  take(g, kind, n, wanted, series, scratch);
  lowpass_t f;
  lowpass_init(&f, fmin(RESIDUAL_SMOOTH_HZ, 0.4 / g->period_s), 1.0 / g->period_s, 0.0);
  if (n) smooth(&f, g->mark, g->n, scratch);
  for (int i = 0; i < n; i++) pick(&s->smooth, flight, scratch + i, WIDE, row[wanted[i]]);
  if (row[CH_RANGE]) pick(&s->range, flight, series[CH_RANGE], 1, row[CH_RANGE]);
}
