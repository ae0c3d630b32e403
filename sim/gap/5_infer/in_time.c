// in_time.c - pulses and spectral lines in a residual.
#include "gap/5_infer/in_time.h"

#include "base/constants.h"
#include "base/nth.h"
#include "base/wide.h"
#include "gap/5_infer/whiten.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Time scale of flying about, s. Longer pulses count as windows of time, and slower lines repeat places and
// speeds. Estimators and pilots have settled by then. A hum wider than its inverse is the colour of the
// noise.
#define ABOUT_S 1.0

// --- pulses -----------------------------------------------------------------------------------------------

// White weights of a pulse from its first row on; all inner rows have the same weight.
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
  const double *white;  // in standard deviations
  const double *change; // by row, squared change of the commands about it; null: a channel without commands
  double *found, *at, *about; // by pulse: statistic, first row, largest change in its rows
} pulses_t;

// The largest pulse of one length.
typedef struct {
  int at;
  double largest, whole; // statistic; the same before missed commands are allowed for
  double alike, scatter; // squares that it and pulses like it explain; scatter of the statistics
} peak_t;

// --- commands that a log misses

// With fewer rows than commands, unless rows are means, the error of predicted lift and turning grows with
// the change of commands from one row to the next: a set point that jumps makes a pulse, though nothing
// pushes. A row is a difference over the points beside, of numbers filtered over as many (REACH). A motor,
// too, follows late: after log(20) time constants a twentieth of a command is still to come. Measured rotor
// speeds are not late.
enum { REACH = 2 };

static int reach_back(const grid_t *g, const model_t *m) {
  const double slower = fmax(1.0, m->motor_down_over_up);
  const double late_s = log(20.0) * slower * m->motor_tau_s;
  return REACH + (g->by_speeds ? 0 : (int)ceil(late_s / g->period_s));
}

static bool is_commanded(int channel) {
  return channel == CH_FZ || (channel >= CH_WX && channel <= CH_WZ);
}

static double commanded(const grid_t *g, const model_t *m, int channel, int sample) {
  double lift_N = 0.0;
  if (channel != CH_FZ) return grid_turns(g, m, channel - CH_WX, sample);
  for (int i = 0; i < ROTORS; i++) lift_N += g->command_N[i][sample];
  return lift_N / m->mass_kg;
}

static void find_changes(const look_t *l, int channel, double *change) {
  const rows_t *const r = &l->s->smooth;
  for (int i = 0; i < r->n; i++) {
    const grid_t *const g = &l->s->grid[r->flight[i]];
    const int from = (r->point[i] - reach_back(g, l->m)) * g->every,
              to = (r->point[i] + REACH + 1) * g->every;
    const bool missed = grid_misses_commands(g);
    change[i] = 0.0;
    for (int k = from > 0 ? from : 0; missed && k + 1 < to && k + 1 < g->samples; k++) {
      const double step = commanded(g, l->m, channel, k + 1) - commanded(g, l->m, channel, k);
      change[i] = fmax(change[i], step * step);
    }
  }
}

// Divides statistics by the factor by which missed commands widen their scatter, sqrt(1 + c x), x the squared
// change of commands, c by least squares of the squared statistics on x.
static void allow_for_changes(const pulses_t *w, int n, double scatter) {
  double fx = 0.0, xx = 0.0;
  for (int i = 0; i < n; i++) {
    const double x = w->about[i], f = w->found[i] / scatter;
    fx += (f * f - 1.0) * x;
    xx += x * x;
  }
  const double c = xx > 0.0 ? fmax(fx / xx, 0.0) : 0.0;
  for (int i = 0; i < n; i++) w->found[i] /= sqrt(1.0 + c * w->about[i]);
}

// --- the largest

// True if all rows from `from` to two behind the pulse have two before them, and at least ABOUT_S of such
// rows lies before it.
static bool unbroken(const rows_t *r, int from, int rows, int *good_to, int *began) {
  if (*good_to < from) *good_to = *began = from;
  while (*good_to < r->n && *good_to < from + rows + 2 && color_reaches(r, *good_to)) ++*good_to;
  return *good_to >= from + rows + 2 && from - *began >= ABOUT_S * RESIDUAL_HZ;
}

// Returns what pulses of one size explain, at all peaks of the largest one's sign and at least half its size.
// Each place is chosen out of all rows, which costs 2 log(n + 1). found: statistics at successive rows.
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

static double scatter_of(const double *found, int n, double *room) {
  for (int i = 0; i < n; i++) room[i] = fabs(found[i]);
  return n ? nth_smallest(room, n, n / 2) / NTH_NORMAL_MEDIAN : 0.0;
}

// Finds the pulses at all rows; returns how many.
static int find_pulses(const pulses_t *w, const pulse_t *p, int rows) {
  const double *const e = w->white;
  int n = 0, good_to = 0, began = 0;
  for (int i = 2; i + rows + 2 <= w->r->n; i++) {
    if (!unbroken(w->r, i, rows, &good_to, &began)) continue;
    double y = p->first * e[i] + p->second * e[i + 1] + p->after * e[i + rows] + p->last * e[i + rows + 1];
    for (int k = 2; k < rows; k++) y += p->inner * e[i + k];
    w->found[n] = y / sqrt(p->energy);
    w->about[n] = 0.0;
    for (int k = 0; w->change && k < rows + 2; k++) w->about[n] = fmax(w->about[n], w->change[i + k]);
    w->at[n++] = i;
  }
  return n;
}

// room: as many numbers as rows. False: too few pulses to say.
static bool largest_pulse(const pulses_t *w, const pulse_t *p, int rows, double *room, peak_t *peak) {
  const int n = find_pulses(w, p, rows);
  *peak = (peak_t){.scatter = scatter_of(w->found, n, room)};
  if (n <= 20 * rows || !(peak->scatter > 0.0)) return false;
  memcpy(room, w->found, (size_t)n * sizeof *room);
  if (w->change) allow_for_changes(w, n, peak->scatter);
  for (int i = 0; i < n; i++)
    if (fabs(w->found[i]) > fabs(peak->largest))
      peak->largest = w->found[i], peak->whole = room[i], peak->at = (int)w->at[i];
  peak->alike = alike_squares(w->found, n, peak->largest, rows);
  peak->scatter = scatter_of(w->found, n, room);
  return peak->scatter > 0.0;
}

static double time_s(const look_t *l, int row) {
  const rows_t *const r = &l->s->smooth;
  return coordinate_of(COORDINATE_TIME, &l->s->grid[r->flight[row]], l->m, r->point[row]);
}

static void pulses_in(const look_t *l, int ch, cell_t *cell) {
  const color_t *const c = &l->color[ch];
  const int n = l->s->smooth.n;
  double *const room = l->room + 5 * n, *const change = is_commanded(ch) ? l->room + 4 * n : NULL;
  const pulses_t w = {&l->s->smooth, l->room, change, l->room + n, l->room + 2 * n, l->room + 3 * n};
  double *const left = l->room + 6 * n;
  memcpy(left, l->residual[ch], (size_t)n * sizeof *left);
  if (l->s->n_grid > 1) rows_clear(w.r, left, room); // what a flight has all the time is no train of pulses
  color_whiten(c, w.r, left, l->room);
  if (change) find_changes(l, ch, change);
  for (int rows = FILTER_ROWS; rows < ABOUT_S * RESIDUAL_HZ; rows *= 2) {
    const pulse_t p = pulse_of(c, rows);
    peak_t peak;
    if (!largest_pulse(&w, &p, rows, room, &peak) || fabs(peak.largest) <= cell->statistic * peak.scatter)
      continue;
    *cell = (cell_t){.channel = ch,
                     .along = COORDINATE_TIME,
                     .coordinate = coordinate_name(COORDINATE_TIME),
                     .unit = coordinate_unit(COORDINATE_TIME),
                     .from = time_s(l, peak.at),
                     .to = time_s(l, peak.at + rows - 1),
                     .size = c->sd * peak.whole / sqrt(p.energy),
                     .statistic = fabs(peak.largest) / peak.scatter,
                     .explained = peak.alike,
                     .is_pulse = true,
                     .log = l->s->grid[w.r->flight[peak.at]].flight};
  }
}

void in_time_pulses(const look_t *l, cell_t cell[LOOKED]) {
  for (int k = 0; k < LOOKED_SMOOTH; k++) {
    const int ch = look_channel(0, k);
    if (l->color[ch].used) pulses_in(l, ch, &cell[ch]);
  }
}

// --- lines ------------------------------------------------------------------------------------------------

// Length of a stretch, s. A line is a sixteenth of a hertz wide: a flight of 16 s holds no narrower one.
#define STRETCH_S 16

enum {
  LINES = STRETCH_S * RESIDUAL_SMOOTH_HZ,
  OWN = 2, // lines on either side over which Hann's taper spreads one
};
// Number of lines on either side that a line is compared with, and the slowest line that is judged: the
// vehicle's own motion spreads over so many.
static const int BESIDE = (int)(STRETCH_S / ABOUT_S);

// Of all channels, side by side.
typedef struct {
  double power[LINES + 1][WIDE];
  int stretches;
} spectrum_t;

// What a row adds to lines 0, 1, ..: each is the one before, turned by an angle that depends on the row's
// time alone, in every channel. Four rows are turned together, because with one each step would wait for the
// one before.
typedef struct {
  four_t x[HALVES], y[HALVES];
  double c, s;
} turning_t;

WIDE_INLINE void turn_on(double c, double s, four_t *x, four_t *y) {
  const four_t next = c * *x - s * *y;
  *y = s * *x + c * *y;
  *x = next;
}

// Of half of the channels: two sums, of even and of odd rows.
typedef struct {
  four_t re[2], im[2];
} line_t;

// A stretch of rows of one flight; v: WIDE numbers a row.
typedef struct {
  const look_t *l;
  const double *v;
  int from, to;
  double start_s, span_s;
} stretch_t;

// Loads row i, tapered; behind the end zeros without weight.
static void take_row(const stretch_t *s, int i, turning_t *t, double *weights) {
  *t = (turning_t){.c = 0.0};
  if (i >= s->to) return;
  const double t_s = time_s(s->l, i) - s->start_s, turn = 2.0 * PI * t_s / STRETCH_S;
  const double taper = 0.5 - 0.5 * cos(2.0 * PI * t_s / s->span_s);
  for (int half = 0; half < HALVES; half++) {
    four_t v;
    FOUR_LOAD(v, s->v + WIDE * i + HALF * half);
    t->x[half] = taper * v;
  }
  t->c = cos(turn);
  t->s = sin(turn);
  *weights += taper * taper;
}

// Adds what four rows have of lines 0 to last.
WIDE_COPIES static void add_lines(const turning_t row[4], int last, line_t sum[HALVES][LINES + 1]) {
  for (int half = 0; half < HALVES; half++) {
    four_t x[4], y[4];
    for (int i = 0; i < 4; i++) x[i] = row[i].x[half], y[i] = row[i].y[half];
    for (int k = 0; k <= last; k++) {
      line_t *const line = &sum[half][k];
      for (int i = 0; i < 2; i++) {
        line->re[i] = line->re[i] + x[i] + x[i + 2];
        line->im[i] = line->im[i] + y[i] + y[i + 2];
      }
      for (int i = 0; i < 4; i++) turn_on(row[i].c, row[i].s, &x[i], &y[i]);
    }
  }
}

// Adds the power of a stretch, tapered (Hann) by time, in lines 0 to last.
static void add_stretch(const look_t *l, const double *v, int from, int to, int last, spectrum_t *sum) {
  line_t line[HALVES][LINES + 1];
  double weights = 0.0;
  memset(line, 0, sizeof line);
  const double start_s = time_s(l, from), span_s = time_s(l, to - 1) - start_s;
  const stretch_t s = {l, v, from, to, start_s, span_s};
  for (int i = from; i < to; i += 4) {
    turning_t row[4];
    for (int k = 0; k < 4; k++) take_row(&s, i + k, &row[k], &weights);
    add_lines(row, last, line);
  }
  for (int half = 0; half < HALVES; half++)
    for (int k = 0; k <= last; k++) {
      const line_t *const of = &line[half][k];
      const four_t x = of->re[0] + of->re[1], y = of->im[0] + of->im[1], power = (x * x + y * y) / weights;
      for (int i = 0; i < HALF; i++) sum->power[k][HALF * half + i] += power[i];
    }
  sum->stretches++;
}

// Adds up stretches that overlap by half. One with less than half of its rows tells nothing of lines.
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

static double beside(const spectrum_t *p, int lane, int at) {
  double power[LINES];
  int n = 0;
  for (int k = at - BESIDE; k <= at + BESIDE; k++)
    if (k > 0 && k <= LINES && abs(k - at) > OWN) power[n++] = p->power[k][lane];
  return nth_smallest(power, n, n / 2);
}

// Returns the line with the largest statistic above *largest, which it raises; 0: none.
static int best_line(const spectrum_t *white, int lane, double *largest) {
  int best = 0;
  for (int k = BESIDE; white->stretches && k <= LINES - OWN; k++) {
    const double statistic = sqrt(white->power[k][lane] / beside(white, lane, k));
    if (statistic > *largest) *largest = statistic, best = k;
  }
  return best;
}

// A tapered sine of amplitude A has the power A^2/4 (sum of the taper)^2 / (sum of its squares); that ratio
// is 2/3 of the rows. It explains A^2/2 a row.
static cell_t line_of(const look_t *l, int lane, int line, const spectrum_t *white, const spectrum_t *raw,
                      double statistic) {
  const double rows = STRETCH_S * RESIDUAL_HZ;
  return (cell_t){.channel = look_channel(0, lane),
                  .along = NOWHERE,
                  .coordinate = "frequency",
                  .unit = "Hz",
                  .from = (line - 1.0) / STRETCH_S,
                  .to = (line + 1.0) / STRETCH_S,
                  .size = sqrt(4.0 * raw->power[line][lane] / raw->stretches / (2.0 / 3.0 * rows)),
                  .statistic = statistic,
                  .spreads = BESIDE,
                  .explained = 3.0 * white->power[line][lane] / white->stretches * l->s->smooth.n / rows};
}

// Returns the channels that are looked at, side by side, as they are or white.
static const double *side_by_side_of(const look_t *l, bool white) {
  const rows_t *const r = &l->s->smooth;
  double *const all = l->room + 2 * set_most_rows(l->s);
  for (int k = 0; k < WIDE; k++) {
    const int ch = look_channel(0, k);
    const bool used = k < LOOKED_SMOOTH && l->color[ch].used;
    const double *const v = used && !white ? l->residual[ch] : l->room;
    if (used && white) color_whiten(&l->color[ch], r, l->residual[ch], l->room);
    for (int i = 0; i < r->n; i++) all[WIDE * i + k] = used ? v[i] : 0.0;
  }
  return all;
}

void in_time_lines(const look_t *l, cell_t cell[LOOKED]) {
  int best[LOOKED_SMOOTH] = {0}, last = 0;
  double statistic[LOOKED_SMOOTH];
  const spectrum_t white = spectrum_of(l, side_by_side_of(l, true), LINES);
  for (int k = 0; k < LOOKED_SMOOTH; k++) {
    statistic[k] = cell[look_channel(0, k)].statistic;
    if (l->color[look_channel(0, k)].used) best[k] = best_line(&white, k, &statistic[k]);
    if (best[k] > last) last = best[k];
  }
  if (!last) return;
  const spectrum_t raw = spectrum_of(l, side_by_side_of(l, false), last);
  for (int k = 0; k < LOOKED_SMOOTH; k++)
    if (best[k]) cell[look_channel(0, k)] = line_of(l, k, best[k], &white, &raw, statistic[k]);
}
