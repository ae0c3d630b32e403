// profile.c - held-out rows over a coordinate.
#include "gap/8_report/report.h"

#include "base/by_size.h"
#include "base/nth.h"
#include <math.h>
#include <stdlib.h>

#define BIN_ROWS_MIN 6    // of a range
#define OUTSIDE      0.01 // of the rows, on each side, that no range reaches to
#define TAIL         0.05 // of the sum of squares on each side of `where`

const char *report_place(const cell_t *c, char text[REPORT_PLACE]) {
  const int n = snprintf(text, REPORT_PLACE, "%s %.3g to %.3g %s", c->coordinate, c->from, c->to, c->unit);
  if (c->is_patch) snprintf(text + n, REPORT_PLACE - (size_t)n, ", y %.3g to %.3g m", c->y_from_m, c->y_to_m);
  return text;
}

static double at(const report_t *r, int channel, int coordinate, int row) {
  const set_t *const s = &r->study->diagnosis.held;
  const rows_t *const rows = set_rows(s, channel);
  return coordinate_of(coordinate, &s->grid[rows->flight[row]], &r->study->vehicle, rows->point[row]);
}

interval_t report_span(const set_t *s, const rows_t *rows, const model_t *m, int coordinate, double outside) {
  double *const x = malloc(((size_t)rows->n + 1) * sizeof *x);
  int n = 0;
  for (int i = 0; x && i < rows->n; i++) {
    x[n] = coordinate_of(coordinate, &s->grid[rows->flight[i]], m, rows->point[i]);
    n += !isnan(x[n]);
  }
  interval_t span = {(double)NAN, (double)NAN};
  if (n) {
    const int least = (int)(outside * n);
    span = (interval_t){nth_smallest(x, n, least), nth_smallest(x, n, n - 1 - least)};
  }
  free(x);
  return span;
}

static void add_row(profile_t *p, int bin, const report_t *r, int i, double effect, double variance) {
  p->x[bin] += at(r, p->channel, p->coordinate, i);
  p->before[bin] += r->before.r[p->channel][i];
  p->after[bin] += r->after.r[p->channel][i];
  p->effect[bin] += effect;
  p->low[bin] += sqrt(variance);
  p->rows[bin] += 1.0;
}

// Sums become means; what has too few rows goes.
static void close_bins(profile_t *p) {
  p->n = 0;
  for (int k = 0; k < REPORT_BINS; k++) {
    const double n = p->rows[k];
    if (n < BIN_ROWS_MIN) continue;
    const int to = p->n++;
    const double effect = p->effect[k] / n, wide = p->low[k] / n;
    p->x[to] = p->x[k] / n, p->rows[to] = n;
    p->before[to] = p->before[k] / n, p->after[to] = p->after[k] / n;
    p->effect[to] = effect, p->low[to] = effect - wide, p->high[to] = effect + wide;
  }
}

// What a picture spans: all rows but the outermost, or what matters and about as much beside it.
static interval_t span_of(const report_t *r, const profile_t *p, const interval_t *near) {
  const set_t *const held = &r->study->diagnosis.held;
  const interval_t s =
      report_span(held, set_rows(held, p->channel), &r->study->vehicle, p->coordinate, OUTSIDE);
  if (!near || 3.0 * (near->to - near->from) > s.to - s.from) return s;
  const double wide = fmax(near->to - near->from, 0.05 * (s.to - s.from));
  return (interval_t){fmax(s.from, near->from - wide), fmin(s.to, near->to + 1.5 * wide)};
}

void report_profile(const report_t *r, const double *effect, const double *variance, const interval_t *near,
                    profile_t *p) {
  *p = (profile_t){.channel = p->channel, .coordinate = p->coordinate};
  const interval_t s = span_of(r, p, near);
  const rows_t *const rows = set_rows(&r->study->diagnosis.held, p->channel);
  for (int i = 0; i < rows->n && s.to > s.from; i++) {
    const double x = at(r, p->channel, p->coordinate, i);
    if (!(x >= s.from && x <= s.to)) continue;
    const int bin = (int)fmin(REPORT_BINS - 1, floor(REPORT_BINS * (x - s.from) / (s.to - s.from)));
    add_row(p, bin, r, i, effect ? effect[i] : 0.0, variance ? variance[i] : 0.0);
  }
  close_bins(p);
}

// --- which coordinate -------------------------------------------------------------------------------------

typedef struct {
  double x, square;
} mark_t;

static int by_x(const void *a, const void *b) {
  return by_size(&((const mark_t *)a)->x, &((const mark_t *)b)->x);
}

interval_t report_where(const report_t *r, const profile_t *p, const double *effect) {
  const rows_t *const rows = set_rows(&r->study->diagnosis.held, p->channel);
  mark_t *const mark = malloc(((size_t)rows->n + 1) * sizeof *mark);
  interval_t where = {0.0, 0.0};
  double all = 0.0, sum = 0.0;
  int n = 0, first = 0, last = 0;
  for (int i = 0; mark && i < rows->n; i++) {
    const double x = at(r, p->channel, p->coordinate, i);
    if (!isnan(x)) mark[n++] = (mark_t){x, effect[i] * effect[i]};
  }
  if (n) qsort(mark, (size_t)n, sizeof *mark, by_x);
  for (int i = 0; i < n; i++) all += mark[i].square;
  for (int i = 0; i < n; i++) {
    if (sum < TAIL * all) first = i;
    sum += mark[i].square;
    if (sum <= (1.0 - TAIL) * all) last = i;
  }
  if (n) where = (interval_t){mark[first].x, mark[first > last ? first : last].x};
  free(mark);
  return where;
}

static double square_correlation(const double *sum, double n) {
  const double xx = sum[2] - sum[0] * sum[0] / n, yy = sum[3] - sum[1] * sum[1] / n;
  const double xy = sum[4] - sum[0] * sum[1] / n;
  return xx > 0.0 && yy > 1e-12 * sum[3] ? xy * xy / (xx * yy) : 0.0;
}

double report_explained(const report_t *r, const profile_t *p, const double *effect) {
  const rows_t *const rows = set_rows(&r->study->diagnosis.held, p->channel);
  double sum[2][5] = {{0.0}}, n = 0.0;
  for (int i = 0; i < rows->n; i++) {
    const double x = at(r, p->channel, p->coordinate, i), y = effect[i];
    if (isnan(x)) continue;
    n += 1.0;
    for (int k = 0; k < 2; k++) {
      const double own = k ? fabs(x) : x, add[5] = {own, y, own * own, y * y, own * y};
      for (int q = 0; q < 5; q++) sum[k][q] += add[q];
    }
  }
  return n > 0.0 ? fmax(square_correlation(sum[0], n), square_correlation(sum[1], n)) : -1.0;
}

double report_rms(const report_t *r, const profile_t *p, const interval_t *span, const double *residual) {
  double sum = 0.0, n = 0.0;
  for (int i = 0; i < set_rows(&r->study->diagnosis.held, p->channel)->n; i++) {
    const double x = at(r, p->channel, p->coordinate, i);
    if (!(x >= span->from && x <= span->to)) continue;
    sum += residual[i] * residual[i];
    n += 1.0;
  }
  return n > 0.0 ? sqrt(sum / n) : 0.0;
}

// --- curves.csv -------------------------------------------------------------------------------------------

void report_curves(const report_t *r, FILE *out) {
  fputs(
      "effect,channel,channel_unit,coordinate,coordinate_unit,at,rows,adds,low,high,measured,before,after\n",
      out);
  for (int i = 0; i < r->n_finding; i++) {
    const finding_t *const f = &r->finding[i];
    const profile_t *const p = &f->profile;
    for (int k = 0; k < p->n; k++)
      fprintf(out, "%s,%s,%s,%s,%s,%.6g,%.0f,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", f->fx->name,
              gap_channel[p->channel], gap_unit[p->channel], coordinate_name(p->coordinate),
              coordinate_unit(p->coordinate), p->x[k], p->rows[k], p->effect[k], p->low[k], p->high[k],
              p->effect[k] + p->after[k], p->before[k], p->after[k]);
  }
}
