// in_time.c - what is short, and what swings.
#include "gap/5_infer/in_time.h"

#include "base/constants.h"
#include "base/nth.h"
#include "base/pair.h"
#include "gap/5_infer/whiten.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// What lasts as long, in seconds, is how the vehicle flies about: longer pulses are windows of time, slower
// lines repeat places and speeds, estimators and pilots have begun with it, and a hum wider than its inverse
// is the colour of the noise.
#define ABOUT_S 1.0

// --- pulses -----------------------------------------------------------------------------------------------

// White weights of a pulse of so many rows, from its first row on: those of the rows between are all alike.
typedef struct {
  double first, second, inner, after, last, energy;
} pulse_t;

static pulse_t pulse_of(const color_t *c, int rows) {
  pulse_t p = {.first = 1.0,
               .second = 1.0 - c->a1,
               .inner = 1.0 - c->a1 - c->a2,
               .after = -c->a1 - c->a2,
               .last = -c->a2};
  p.energy = p.first * p.first + p.second * p.second + (rows - 2) * p.inner * p.inner + p.after * p.after +
             p.last * p.last;
  return p;
}

typedef struct {
  const rows_t *r;
  const double *white; // in standard deviations
  double *found;       // statistics
} pulses_t;

// Row `from` and all rows to two behind the pulse reach back without a gap.
static bool unbroken(const rows_t *r, int from, int rows, int *good_to, int *began) {
  if (*good_to < from) *good_to = *began = from;
  while (*good_to < r->n && *good_to < from + rows + 2 && color_reaches(r, *good_to)) ++*good_to;
  return *good_to >= from + rows + 2 && from - *began >= ABOUT_S * RESIDUAL_HZ;
}

// Of statistics at successive rows: what pulses of one size explain, at all peaks of the largest's sign that
// are half as large or more. Where one is is chosen out of all rows, and that costs.
static double alike_squares(const double *found, int n, double largest, int rows) {
  const double sign = largest > 0.0 ? 1.0 : -1.0, dear = 2.0 * log(n + 1.0);
  double sum = 0.0;
  int peaks = 0;
  for (int i = 0; i < n; i++) {
    if (!(sign * found[i] > 0.5 * fabs(largest))) continue;
    double peak = 0.0;
    const int end = i + rows + 2 < n ? i + rows + 2 : n;
    for (; i < end; i++) peak = fmax(peak, sign * found[i]);
    sum += peak;
    peaks++;
  }
  return peaks ? fmax(sum * sum / peaks - peaks * dear, 0.0) : 0.0;
}

// The largest of one length, the squares of all that are half as large, and what they scatter by. False: too
// few to say.
static bool largest_pulse(const pulses_t *w, const pulse_t *p, int rows, int *at, double *largest,
                          double *alike, double *scatter) {
  const double *const e = w->white;
  int n = 0, good_to = 0, began = 0;
  *largest = 0.0;
  for (int i = 2; i + rows + 2 <= w->r->n; i++) {
    if (!unbroken(w->r, i, rows, &good_to, &began)) continue;
    double y = p->first * e[i] + p->second * e[i + 1] + p->after * e[i + rows] + p->last * e[i + rows + 1];
    for (int k = 2; k < rows; k++) y += p->inner * e[i + k];
    y /= sqrt(p->energy);
    w->found[n++] = y;
    if (fabs(y) > fabs(*largest)) *largest = y, *at = i;
  }
  *alike = alike_squares(w->found, n, *largest, rows);
  for (int i = 0; i < n; i++) w->found[i] = fabs(w->found[i]);
  *scatter = n ? nth_smallest(w->found, n, n / 2) / 0.6745 : 0.0;
  return n > 20 * rows && *scatter > 0.0;
}

static double time_s(const look_t *l, int row) {
  const rows_t *const r = &l->s->smooth;
  return coordinate_of(COORDINATE_TIME, &l->s->grid[r->flight[row]], l->m, r->point[row]);
}

static void pulses_in(const look_t *l, int ch, cell_t *cell) {
  const color_t *const c = &l->color[ch];
  const pulses_t w = {&l->s->smooth, l->room, l->room + l->s->smooth.n};
  color_whiten(c, w.r, l->residual[ch], l->room);
  for (int rows = FILTER_ROWS; rows < ABOUT_S * RESIDUAL_HZ; rows *= 2) {
    const pulse_t p = pulse_of(c, rows);
    double largest, alike, scatter;
    int at = 0;
    if (!largest_pulse(&w, &p, rows, &at, &largest, &alike, &scatter) ||
        fabs(largest) <= cell->statistic * scatter)
      continue;
    *cell = (cell_t){.channel = ch,
                     .along = COORDINATE_TIME,
                     .coordinate = coordinate_name(COORDINATE_TIME),
                     .unit = coordinate_unit(COORDINATE_TIME),
                     .from = time_s(l, at),
                     .to = time_s(l, at + rows - 1),
                     .size = c->sd * largest / sqrt(p.energy),
                     .statistic = fabs(largest) / scatter,
                     .explained = alike};
  }
}

void in_time_pulses(const look_t *l, cell_t cell[CHANNELS]) {
  for (int ch = 0; ch < CH_SMOOTH; ch++)
    if (l->color[ch].used) pulses_in(l, ch, &cell[ch]);
}

// --- lines ------------------------------------------------------------------------------------------------

// A line is a sixteenth of a hertz wide: a flight of 16 s holds no narrower one.
#define STRETCH_S 16

enum {
  LINES = STRETCH_S * RESIDUAL_SMOOTH_HZ,
  OWN = 2, // lines either side that Hann's taper spreads one over
};
// Lines either side that one is compared with, and the slowest one.
static const int BESIDE = (int)(STRETCH_S / ABOUT_S);

typedef struct {
  double power[LINES + 1];
  int stretches;
} spectrum_t;

// What a row has of lines 0, 1, ..: each is the one before, turned on. Two rows at once, and two of these:
// one alone would wait for itself.
typedef struct {
  pair_t x, y, c, s;
} turning_t;

static inline void turn_on(turning_t *t) {
  const pair_t next = t->c * t->x - t->s * t->y;
  t->y = t->s * t->x + t->c * t->y;
  t->x = next;
}

static double put_row(turning_t *t, int which, double t_s, double span_s, double v) {
  const double turn = 2.0 * PI * t_s / STRETCH_S, taper = 0.5 - 0.5 * cos(2.0 * PI * t_s / span_s);
  t->x[which] = taper * v;
  t->y[which] = 0.0;
  t->c[which] = cos(turn);
  t->s[which] = sin(turn);
  return taper * taper;
}

// A stretch of rows of one flight.
typedef struct {
  const look_t *l;
  const double *v;
  int from, to;
  double start_s, span_s;
} stretch_t;

// Two rows from i on; behind the end there are none, and weigh nothing.
static turning_t two_rows(const stretch_t *s, int i, double *weights) {
  turning_t t = {pair_both(0.0), pair_both(0.0), pair_both(0.0), pair_both(0.0)};
  for (int which = 0; which < 2 && i + which < s->to; which++)
    *weights += put_row(&t, which, time_s(s->l, i + which) - s->start_s, s->span_s, s->v[i + which]);
  return t;
}

// Tapered (Hann) by time; lines 0 to last.
static void add_stretch(const look_t *l, const double *v, int from, int to, int last, spectrum_t *sum) {
  pair_t re[LINES + 1], im[LINES + 1];
  double weights = 0.0;
  for (int k = 0; k <= last; k++) re[k] = im[k] = pair_both(0.0);
  const double start_s = time_s(l, from), span_s = time_s(l, to - 1) - start_s;
  const stretch_t s = {l, v, from, to, start_s, span_s};
  for (int i = from; i < to; i += 4) {
    turning_t t = two_rows(&s, i, &weights), u = two_rows(&s, i + 2, &weights);
    for (int k = 0; k <= last; k++) {
      re[k] = re[k] + t.x + u.x;
      im[k] = im[k] + t.y + u.y;
      turn_on(&t);
      turn_on(&u);
    }
  }
  for (int k = 0; k <= last; k++) {
    const double x = pair_sum(re[k]), y = pair_sum(im[k]);
    sum->power[k] += (x * x + y * y) / weights;
  }
  sum->stretches++;
}

// Half stretches overlap. What is shorter than half of one says nothing of lines.
static spectrum_t spectrum_of(const look_t *l, const double *v, int last) {
  const rows_t *const r = &l->s->smooth;
  spectrum_t sum = {.stretches = 0};
  const int rows = (int)(STRETCH_S * RESIDUAL_HZ);
  for (int from = 0; from < r->n;) {
    int to = from, half = from;
    const double start_s = time_s(l, from);
    while (to < r->n && r->flight[to] == r->flight[from] && time_s(l, to) < start_s + STRETCH_S) {
      if (time_s(l, to) < start_s + 0.5 * STRETCH_S) half = to + 1;
      to++;
    }
    if (to - from >= rows / 2) add_stretch(l, v, from, to, last, &sum);
    from = half;
  }
  return sum;
}

static double beside(const spectrum_t *p, int at) {
  double power[LINES];
  int n = 0;
  for (int k = at - BESIDE; k <= at + BESIDE; k++)
    if (k > 0 && k <= LINES && abs(k - at) > OWN) power[n++] = p->power[k];
  return nth_smallest(power, n, n / 2);
}

static void lines_in(const look_t *l, int ch, cell_t *cell) {
  const color_t *const c = &l->color[ch];
  color_whiten(c, &l->s->smooth, l->residual[ch], l->room);
  const spectrum_t white = spectrum_of(l, l->room, LINES);
  int best = 0;
  double largest = cell->statistic;
  for (int k = BESIDE; white.stretches && k <= LINES - OWN; k++) {
    const double statistic = sqrt(white.power[k] / beside(&white, k));
    if (statistic > largest) largest = statistic, best = k;
  }
  if (!best) return;
  const spectrum_t raw = spectrum_of(l, l->residual[ch], best);
  // Of a sine A sin, tapered: power A^2/4 (sum of the taper)^2 / (sum of its squares), 2/3 of the rows. It
  // explains A^2/2 a row.
  const double rows = STRETCH_S * RESIDUAL_HZ;
  *cell = (cell_t){.channel = ch,
                   .along = NOWHERE,
                   .coordinate = "frequency",
                   .unit = "Hz",
                   .from = (best - 1.0) / STRETCH_S,
                   .to = (best + 1.0) / STRETCH_S,
                   .size = sqrt(4.0 * raw.power[best] / raw.stretches / (2.0 / 3.0 * rows)),
                   .statistic = largest,
                   .explained = 3.0 * white.power[best] / white.stretches * l->s->smooth.n / rows};
}

void in_time_lines(const look_t *l, cell_t cell[CHANNELS]) {
  for (int ch = 0; ch < CH_SMOOTH; ch++)
    if (l->color[ch].used) lines_in(l, ch, &cell[ch]);
}
