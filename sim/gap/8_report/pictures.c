// pictures.c - the page's pictures.
#include "gap/8_report/page.h"

#include "base/by_size.h"
#include "gap/8_report/svg.h"
#include <math.h>
#include <stdlib.h>

#define LABEL 96

static const char *of_coordinate(int coordinate, char text[LABEL]) {
  snprintf(text, LABEL, "%s, %s", coordinate_name(coordinate), coordinate_unit(coordinate));
  return text;
}

static const char *of_channel(int channel, const char *what, char text[LABEL]) {
  snprintf(text, LABEL, "%s%s, %s", what, gap_channel[channel], gap_unit[channel]);
  return text;
}

void picture_curve(const finding_t *f, FILE *out) {
  const profile_t *const p = &f->profile;
  double seen[REPORT_BINS], zero[1] = {0.0};
  char x[LABEL], y[LABEL], name[LABEL];
  for (int k = 0; k < p->n; k++) seen[k] = p->effect[k] + p->after[k];
  chart_t c = svg_frame(out);
  svg_hold(&c, p->n, p->x, p->low);
  svg_hold(&c, p->n, p->x, p->high);
  svg_hold(&c, p->n, p->x, seen);
  svg_hold(&c, p->n ? 1 : 0, p->x, zero);
  snprintf(name, sizeof name, "What %s adds", f->fx->name);
  svg_open(&c, name, of_coordinate(p->coordinate, x), of_channel(p->channel, "", y));
  svg_band(&c, p->n, p->x, p->low, p->high, "band", "+- standard error");
  svg_line(&c, p->n, p->x, p->effect, "after", f->fx->name);
  svg_dots(&c, p->n, p->x, seen, "seen", "measured, rest taken out");
  svg_close(&c);
}

void picture_place(const profile_t *p, double from, double to, const char *mark, FILE *out) {
  char x[LABEL], y[LABEL];
  const double zero[1] = {0.0};
  chart_t c = svg_frame(out);
  svg_hold(&c, p->n, p->x, p->before);
  svg_hold(&c, p->n, p->x, p->after);
  svg_hold(&c, p->n ? 1 : 0, p->x, zero);
  svg_open(&c, "Where the gap is", of_coordinate(p->coordinate, x),
           of_channel(p->channel, "mean residual of ", y));
  if (from != 0.0 || to != 0.0) svg_range(&c, from, to, "mark", mark);
  svg_line(&c, p->n, p->x, p->before, "before", "before");
  svg_dots(&c, p->n, p->x, p->before, "before-dot", NULL);
  svg_line(&c, p->n, p->x, p->after, "after", "after");
  svg_dots(&c, p->n, p->x, p->after, "after-dot", NULL);
  svg_close(&c);
}

// What lies between 1 in 500 from below and from above: a single peak must not flatten the rest.
static void hold_most(chart_t *c, int n, const double *t, const double *v) {
  double *const s = malloc(((size_t)n + 1) * sizeof(double));
  for (int i = 0; s && i < n; i++) s[i] = v[i];
  if (s && n) {
    qsort(s, (size_t)n, sizeof *s, by_size);
    const double ends[2] = {s[n / 500], s[n - 1 - n / 500]}, when[2] = {t[0], t[n - 1]};
    svg_hold(c, 2, when, ends);
  }
  free(s);
}

// Flights one after the other, on one time that has no gaps.
void picture_time(const report_t *r, int channel, FILE *out) {
  const set_t *const s = &r->study->diagnosis.held;
  const rows_t *const rows = set_rows(s, channel);
  double *const t = malloc(((size_t)rows->n + 1) * sizeof(double));
  char y[LABEL];
  double shift_s = 0.0;
  for (int i = 0; t && i < rows->n; i++) {
    const double own_s = s->grid[rows->flight[i]].point[rows->point[i]].t_s;
    if (i == 0)
      shift_s = -own_s;
    else if (rows->flight[i] != rows->flight[i - 1] || own_s + shift_s - t[i - 1] > 2.0)
      shift_s = t[i - 1] + 0.1 - own_s;
    t[i] = own_s + shift_s;
  }
  if (t && rows->n) {
    chart_t c = svg_frame(out);
    hold_most(&c, rows->n, t, r->before.r[channel]);
    hold_most(&c, rows->n, t, r->after.r[channel]);
    svg_open(&c, "Residual of the held-out flights", "time in the held-out flights, s",
             of_channel(channel, "", y));
    svg_line(&c, rows->n, t, r->before.r[channel], "before thin", "before");
    svg_line(&c, rows->n, t, r->after.r[channel], "after thin", "after");
    svg_close(&c);
  }
  free(t);
}

static double far(const resimulation_t *a, double *const at_m[3], int axis) {
  double sum = 0.0;
  for (int j = 0; j < a->n; j++) {
    const double off = at_m[axis][j] - a->measured_m[axis][j];
    if (isfinite(off)) sum += off * off;
  }
  return sum;
}

// The axis that the new model improves most; where it improves none, the one that the old one misses most.
static int axis_of(const resimulation_t *a) {
  int better = -1, worst = 2;
  double most = 0.0;
  for (int k = 2; k >= 0; k--) {
    const double before = far(a, a->before_at_m, k), gain = before - far(a, a->after_at_m, k);
    if (before > far(a, a->before_at_m, worst)) worst = k;
    if (!(gain > most)) continue;
    most = gain;
    better = k;
  }
  return better < 0 ? worst : better;
}

// How far the two models are from the measured track.
static void draw_errors(const resimulation_t *a, double *const off[2], const char *label, FILE *out) {
  chart_t c = svg_frame(out);
  svg_hold(&c, a->n, a->t_s, off[0]);
  svg_hold(&c, a->n, a->t_s, off[1]);
  svg_open(&c, "The held-out flight, flown again", "time, s", label);
  svg_line(&c, a->n, a->t_s, off[0], "before thin", "old model");
  svg_line(&c, a->n, a->t_s, off[1], "after thin", "new model");
  svg_close(&c);
}

void picture_track(const resimulation_t *a, FILE *out) {
  static const char *const NAME[] = {"error in x, m", "error in y, m", "error in height, m"};
  const int axis = axis_of(a);
  double *const off[2] = {malloc(((size_t)a->n + 1) * sizeof(double)),
                          malloc(((size_t)a->n + 1) * sizeof(double))};
  for (int j = 0; off[0] && off[1] && j < a->n; j++) {
    off[0][j] = a->before_at_m[axis][j] - a->measured_m[axis][j];
    off[1][j] = a->after_at_m[axis][j] - a->measured_m[axis][j];
  }
  if (off[0] && off[1]) draw_errors(a, off, NAME[axis], out);
  free(off[0]);
  free(off[1]);
}
