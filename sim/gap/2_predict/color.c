// color.c - coloured noise of a channel, and random constants of flights.
#include "gap/2_predict/color.h"

#include "base/wide.h"
#include <math.h>
#include <string.h>

#define ROWS_MIN 40

// Normal equations of an autoregression of second order.
color_t color_fit(const rows_t *r, const double *v) {
  double s11 = 0.0, s12 = 0.0, s22 = 0.0, s01 = 0.0, s02 = 0.0, s00 = 0.0;
  int n = 0;
  for (int i = 2; i < r->n; i++) {
    if (!color_reaches(r, i)) continue;
    const double y = v[i], p = v[i - 1], q = v[i - 2];
    s00 += y * y;
    s01 += y * p;
    s02 += y * q;
    s11 += p * p;
    s12 += p * q;
    s22 += q * q;
    n++;
  }
  const double det = s11 * s22 - s12 * s12;
  if (n < ROWS_MIN || !(det > 1e-12 * s11 * s22)) return (color_t){.used = false};
  color_t c = {.a1 = (s01 * s22 - s02 * s12) / det, .a2 = (s02 * s11 - s01 * s12) / det};
  c.sd = sqrt(fmax(s00 - c.a1 * s01 - c.a2 * s02, 0.0) / n);
  c.used = c.sd > 0.0;
  return c;
}

color_t color_plain(const rows_t *r, const double *v) {
  double squares = 0.0;
  for (int i = 0; i < r->n; i++) squares += v[i] * v[i];
  const color_t c = color_fit(r, v);
  return (color_t){.sd = r->n ? sqrt(squares / r->n) : 0.0, .used = c.used};
}

WIDE_COPIES static void whiten_all(double a1, double a2, double per_sd, int n, const double *v, double *out) {
  for (int i = 2; i < n; i++) out[i] = per_sd * (v[i] - a1 * v[i - 1] - a2 * v[i - 2]);
}

static void whiten_rows(const color_t *c, const rows_t *r, const double *v, double *out) {
  whiten_all(c->a1, c->a2, 1.0 / c->sd, r->n, v, out);
  for (int i = 0; i < r->n; i++)
    if (!color_reaches(r, i)) out[i] = 0.0;
}

// --- what flights differ by -------------------------------------------------------------------------------

double color_one(const color_t *c, const rows_t *r, int row) {
  if (!color_reaches(r, row)) return 0.0;
  return (rows_lift(r, row) - c->a1 * rows_lift(r, row - 1) - c->a2 * rows_lift(r, row - 2)) / c->sd;
}

color_constant_t color_constant(const color_t *c, const rows_t *r, int from, const double *white) {
  color_constant_t k = {.end = from};
  double product = 0.0;
  for (; k.end < r->n && r->flight[k.end] == r->flight[from]; k.end++) {
    const double one = color_one(c, r, k.end);
    k.holds += one * one;
    product += one * white[k.end];
  }
  k.mean = k.holds > 0.0 ? product / k.holds : 0.0;
  return k;
}

color_differ_t color_differ(const color_t *c, const rows_t *r, const double *white) {
  color_differ_t d = {.flights = 0};
  double sum = 0.0, squares = 0.0;
  for (int from = 0; from < r->n;) {
    const color_constant_t k = color_constant(c, r, from, white);
    from = k.end;
    if (!(k.holds > 0.0)) continue;
    d.flights++;
    d.holds += k.holds;
    d.holds_squared += k.holds * k.holds;
    sum += k.holds * k.mean;
    squares += k.holds * k.mean * k.mean;
  }
  d.mean = d.flights ? sum / d.holds : 0.0;
  d.q = fmax(squares - sum * d.mean, 0.0);
  return d;
}

double color_between(const color_t *c, const rows_t *r, const double *v, double *room) {
  whiten_rows(c, r, v, room);
  const color_differ_t d = color_differ(c, r, room);
  if (d.flights < 2) return 0.0;
  return sqrt(fmax(d.q - (d.flights - 1), 0.0) / (d.holds - d.holds_squared / d.holds));
}

color_t color_of_flights(const rows_t *r, const double *v, double *room) {
  memcpy(room, v, (size_t)r->n * sizeof(double));
  rows_center(r, room);
  color_t c = color_fit(r, room);
  if (c.used) c.between = color_between(&c, r, v, room);
  return c;
}

// Returns the share of a flight's constant that stays in its white rows.
static double kept(const color_t *c, double holds) {
  return 1.0 / sqrt(1.0 + c->between * c->between * holds);
}

void color_whiten(const color_t *c, const rows_t *r, const double *v, double *out) {
  whiten_rows(c, r, v, out);
  for (int from = 0; c->between > 0.0 && from < r->n;) {
    const color_constant_t k = color_constant(c, r, from, out);
    const double less = (1.0 - kept(c, k.holds)) * k.mean;
    for (int i = from; i < k.end; i++) out[i] -= less * color_one(c, r, i);
    from = k.end;
  }
}

double color_left(const rows_t *r, const color_t *c, const double *v) {
  const double spread = c->between * c->between;
  double sum = 0.0, product = 0.0, holds = 0.0;
  for (int i = 0; i < r->n; i++) {
    if (color_reaches(r, i)) {
      const double e = (v[i] - c->a1 * v[i - 1] - c->a2 * v[i - 2]) / c->sd;
      const double one = spread > 0.0 ? color_one(c, r, i) : 0.0;
      sum += e * e;
      product += one * e;
      holds += one * one;
    }
    if (i + 1 < r->n && r->flight[i + 1] == r->flight[i]) continue;
    sum -= spread / (1.0 + spread * holds) * product * product;
    product = holds = 0.0;
  }
  return sum;
}
