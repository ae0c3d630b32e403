// time_base.c - stage 1: resamples streams with time stamps of their own on one uniform time base.
#include "gap/1_read/read.h"

#include <math.h>
#include <stdlib.h>

#define SPLIT_PERIODS 5.0 // a gap between rows that is longer, and longer than SPLIT_S, splits the flight
#define SPLIT_S       0.04
#define BRIDGE_S      0.12 // longest gap in one signal that is interpolated ..
#define BRIDGE_SLOW   3.0  // or, of a slow stream, in usual times between its values
#define CURVE_MAX_S   0.05 // a slower stream is interpolated by lines
#define UNEVEN        3.0  // larger ratio of neighbouring intervals: a line, not a curve

typedef struct {
  int first, last; // rows
  int at, n;       // samples
  double start_s;
} stretch_t;

// The uniform time base. margin_s: left out at both ends of a segment, where shifted signals have no values.
typedef struct {
  double period_s, margin_s, end_s;
} steps_t;

static const signals_t LINEAR =
    COMMANDS | SIGNALS(SIG_F1, SIG_F4) | SIGNALS(SIG_THRUST, SIG_VBAT) | SIGNALS(SIG_SET_X, SIG_SET_YAW);

// Returns the mean time between rows, without gaps; at least the period of GAP_RATE_HZ.
static double grid_period(const raw_t *raw) {
  const double usual_s = raw->period_s * raw->thin;
  double sum_s = 0.0;
  int n = 0;
  for (int i = 1; i < raw->n; i++) {
    const double dt_s = raw->t_s[i] - raw->t_s[i - 1];
    if (dt_s < 0.7 * usual_s || dt_s > 1.3 * usual_s) continue;
    sum_s += dt_s;
    n++;
  }
  return fmax(n > 0 ? sum_s / n : usual_s, 1.0 / GAP_RATE_HZ);
}

// Finds the next run of rows without a gap that splits the flight; false: none is left.
static bool next_segment(const raw_t *raw, const steps_t *g, stretch_t *s) {
  const double split_s = fmax(SPLIT_PERIODS * raw->period_s * raw->thin, SPLIT_S);
  s->at += s->n;
  s->first = s->last + 1;
  if (s->first >= raw->n || raw->t_s[s->first] > g->end_s) return false;
  s->last = s->first;
  while (s->last + 1 < raw->n && raw->t_s[s->last + 1] - raw->t_s[s->last] <= split_s &&
         raw->t_s[s->last + 1] <= g->end_s)
    s->last++;
  s->start_s = raw->t_s[s->first] + g->margin_s;
  const double span_s = raw->t_s[s->last] - g->margin_s - s->start_s;
  s->n = span_s < 0.0 ? 0 : (int)(span_s / g->period_s + 1e-6) + 1;
  return true;
}

// Interpolates between the second and the third of four points: by a cubic, or by a line if they are uneven.
static double curve(const double t[4], const double y[4], double at) {
  const double h = t[2] - t[1], s = (at - t[1]) / h, slope = (y[2] - y[1]) / h;
  const double before = t[1] - t[0], after = t[3] - t[2];
  if (!(before < UNEVEN * h && before > h / UNEVEN && after < UNEVEN * h && after > h / UNEVEN))
    return y[1] + s * h * slope;
  const double m1 = ((y[1] - y[0]) / before * h + slope * before) / (before + h);
  const double m2 = (slope * after + (y[3] - y[2]) / after * h) / (after + h);
  const double r = 1.0 - s;
  return r * r * (1.0 + 2.0 * s) * y[1] + s * s * (1.0 + 2.0 * r) * y[2] + h * s * r * (r * m1 - s * m2);
}

static int next_finite(const double *v, int i, int last) {
  while (i <= last && isnan(v[i])) i++;
  return i;
}

// Interpolates between rows 1 and 2 of four that have the signal; NaN where these are too far apart.
static double between(const raw_t *raw, const int row[4], int last, int signal, double at_s) {
  const double *const v = raw->v[signal], slow_s = raw->slow_s[signal];
  double t[4], y[4];
  for (int i = 0; i < 4; i++) {
    const int j = row[i] <= last ? row[i] : row[2];
    t[i] = raw->t_s[j];
    y[i] = v[j];
  }
  if (t[2] - t[1] > fmax(BRIDGE_S, BRIDGE_SLOW * slow_s)) return (double)NAN;
  if (at_s < t[1]) return y[1];
  if (!(LINEAR & SIGNAL_BIT(signal)) && slow_s < CURVE_MAX_S) return curve(t, y, at_s);
  return y[1] + (at_s - t[1]) / (t[2] - t[1]) * (y[2] - y[1]);
}

static void resample(const raw_t *raw, const stretch_t *s, double period_s, double shift_s, int signal,
                     double *out) {
  const double *const v = raw->v[signal], near_s = 0.6 * period_s;
  int row[4];
  row[1] = row[0] = next_finite(v, s->first, s->last);
  row[2] = next_finite(v, row[1] + 1, s->last);
  row[3] = next_finite(v, row[2] + 1, s->last);
  for (int k = 0; k < s->n; k++) {
    const double at_s = s->start_s + period_s * k + shift_s;
    while (row[2] <= s->last && raw->t_s[row[2]] < at_s) {
      row[0] = row[1];
      row[1] = row[2];
      row[2] = row[3];
      row[3] = next_finite(v, row[3] + 1, s->last);
    }
    out[k] = (double)NAN;
    if (row[1] > s->last || at_s < raw->t_s[row[1]] - near_s) continue;
    if (row[2] <= s->last)
      out[k] = between(raw, row, s->last, signal, at_s);
    else if (at_s < raw->t_s[row[1]] + near_s)
      out[k] = v[row[1]];
  }
}

static bool is_range(int signal) {
  return signal == SIG_RANGE || signal == SIG_RANGE_DOWN;
}

// Puts each new sample at the instant nearest to its row, less `instants`.
static void place(const raw_t *raw, const double *v, const stretch_t *s, double period_s, double instants,
                  double *out) {
  for (int k = 0; k < s->n; k++) out[k] = (double)NAN;
  for (int i = s->first; i <= s->last; i++) {
    const double k = floor((raw->t_s[i] - s->start_s) / period_s + 0.5) - instants;
    if (!isnan(v[i]) && k >= 0.0 && k < s->n) out[(int)k] = v[i];
  }
}

// Fills times and segment numbers, and masks the samples that a command at its limit drives. commands_s is
// subtracted from the commands' time stamps.
static void mark(gap_flight_t *f, const raw_t *raw, const stretch_t *s, int number, double period_s,
                 double commands_s) {
  for (int k = 0; k < s->n; k++) {
    f->t_s[s->at + k] = s->start_s + period_s * k;
    f->segment[s->at + k] = number;
  }
  for (int i = s->first; i <= s->last; i++) {
    if (!raw->at_limit[i]) continue;
    const double k = floor((raw->t_s[i] - commands_s - s->start_s) / period_s);
    for (int j = 0; j < 2; j++)
      if (k + j >= 0.0 && k + j < s->n) f->saturated[s->at + (int)k + j] = true;
  }
}

static void unit_quaternions(gap_flight_t *f) {
  double *const *q = &f->v[SIG_QW];
  for (int i = 0; q[0] && i < f->n; i++) {
    const double norm = sqrt(q[0][i] * q[0][i] + q[1][i] * q[1][i] + q[2][i] * q[2][i] + q[3][i] * q[3][i]);
    for (int k = 0; k < 4; k++) q[k][i] /= norm;
  }
}

static done_t fill_signal(gap_flight_t *f, const raw_t *raw, const steps_t *g, int signal, double shift_s,
                          why_t *why) {
  double *const out = f->v[signal] = malloc(((size_t)f->n + 1) * sizeof(double));
  if (!out) return error_failed(why, "out of memory");
  const double instants = floor(shift_s / g->period_s + 1e-6);
  if (is_range(signal)) f->range_late_s[signal - SIG_RANGE] = fmax(shift_s - instants * g->period_s, 0.0);
  for (stretch_t s = {.last = -1}; next_segment(raw, g, &s);) {
    if (is_range(signal))
      place(raw, raw->v[signal], &s, g->period_s, instants, out + s.at);
    else
      resample(raw, &s, g->period_s, shift_s, signal, out + s.at);
  }
  return DONE;
}

static void turn_acceleration(int n, double *const v[SIG_COUNT], bool to_world) {
  if (!has(v, FORCE) || !has(v, ATTITUDE)) return;
  for (int i = 0; i < n; i++) {
    const dq_t q_wb = attitude_at(v, i);
    const d3_t acc = vector_at(v, SIG_AX, i);
    const d3_t turned = to_world ? dq_to_world(q_wb, acc) : dq_to_body(q_wb, acc);
    v[SIG_AX][i] = turned.x, v[SIG_AY][i] = turned.y, v[SIG_AZ][i] = turned.z;
  }
}

void raw_to_world(raw_t *raw) {
  turn_acceleration(raw->n, raw->v, true);
  raw->acc_in_world = true;
}

done_t gap_grid(gap_flight_t *f, raw_t *raw, signals_t want, const double shift_s[SIG_COUNT], double limit_s,
                bool drop, why_t *why) {
  steps_t g = {grid_period(raw), 0.0, raw->t_s[0] + limit_s};
  for (int i = 0; i < SIG_COUNT; i++)
    if (raw->v[i] && !is_range(i)) g.margin_s = fmax(g.margin_s, fabs(shift_s[i]));
  // Whole periods, so that signals that are not shifted stay on their rows, where commands are as given.
  g.margin_s = g.period_s * ceil(g.margin_s / g.period_s - 1e-6);
  int number = 0;
  f->n = 0;
  for (stretch_t s = {.last = -1}; next_segment(raw, &g, &s);) f->n = s.at + s.n;
  f->rate_Hz = 1.0 / g.period_s;
  const size_t n = (size_t)f->n + 1;
  f->t_s = malloc(n * sizeof(double));
  f->segment = malloc(n * sizeof(int));
  f->saturated = calloc(n, sizeof(bool));
  if (!f->t_s || !f->segment || !f->saturated) return error_failed(why, "out of memory");
  for (stretch_t s = {.last = -1}; next_segment(raw, &g, &s);)
    if (s.n > 0) mark(f, raw, &s, number++, g.period_s, shift_s[SIG_THRUST]);
  for (int i = SIG_X; i < SIG_COUNT; i++) {
    if (!raw->v[i] || !(want & SIGNAL_BIT(i))) continue;
    TRY(fill_signal(f, raw, &g, i, shift_s[i], why));
    if (drop) raw_drop(raw, (signal_id_t)i);
  }
  unit_quaternions(f);
  if (raw->acc_in_world) turn_acceleration(f->n, f->v, false);
  return DONE;
}
