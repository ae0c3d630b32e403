// pictures.c - the page's pictures.
#include "gap/8_report/page.h"

#include "base/by_size.h"
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
  snprintf(name, sizeof name, "What %s adds", f->name);
  svg_open(&c, name, of_coordinate(p->coordinate, x), of_channel(p->channel, "", y));
  svg_band(&c, p->n, p->x, p->low, p->high, "band", "+- standard error");
  svg_line(&c, p->n, p->x, p->effect, "after", f->name);
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

// Fits the frame to all values but the lowest and the highest 1 in 500, so that a single peak does not
// flatten the rest.
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

// Puts the flights one after the other on one time axis, without gaps of more than 2 s.
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

static double squares(const double *v, int n) {
  double sum = 0.0;
  for (int i = 0; i < n; i++)
    if (isfinite(v[i])) sum += v[i] * v[i];
  return sum;
}

// Returns the axis on which the new model improves most; if it improves none, the old model's worst axis.
static int axis_of(const resimulation_t *a) {
  int better = -1, worst = 2;
  double most = 0.0;
  for (int k = 2; k >= 0; k--) {
    const double before = squares(a->before.off_m[k], a->n);
    const double gain = before - squares(a->after.off_m[k], a->n);
    if (before > squares(a->before.off_m[worst], a->n)) worst = k;
    if (!(gain > most)) continue;
    most = gain;
    better = k;
  }
  return better < 0 ? worst : better;
}

void picture_track(const resimulation_t *a, FILE *out) {
  static const char *const NAME[] = {"error in x, m", "error in y, m", "error in height, m"};
  const int axis = axis_of(a);
  chart_t c = svg_frame(out);
  svg_hold(&c, a->n, a->t_s, a->before.off_m[axis]);
  svg_hold(&c, a->n, a->t_s, a->after.off_m[axis]);
  svg_open(&c, "The held-out flight, flown again", "time, s", NAME[axis]);
  svg_line(&c, a->n, a->t_s, a->before.off_m[axis], "before thin", "old model");
  svg_line(&c, a->n, a->t_s, a->after.off_m[axis], "after thin", "new model");
  svg_close(&c);
}

// --- their numbers ----------------------------------------------------------------------------------------

void report_curves(const report_t *r, FILE *out) {
  fputs(
      "effect,channel,channel_unit,coordinate,coordinate_unit,at,rows,adds,low,high,measured,before,after\n",
      out);
  for (int i = 0; i < r->n_finding; i++) {
    const finding_t *const f = &r->finding[i];
    const profile_t *const p = &f->profile;
    for (int k = 0; k < p->n; k++)
      fprintf(out, "%s,%s,%s,%s,%s,%.6g,%.0f,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", f->name,
              gap_channel[p->channel], gap_unit[p->channel], coordinate_name(p->coordinate),
              coordinate_unit(p->coordinate), p->x[k], p->rows[k], p->effect[k], p->low[k], p->high[k],
              p->effect[k] + p->after[k], p->before[k], p->after[k]);
  }
}
