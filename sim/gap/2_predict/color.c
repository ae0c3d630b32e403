// color.c - an autoregression of second order per channel.
#include "gap/2_predict/color.h"

#include "base/wide.h"
#include <math.h>

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

void color_whiten(const color_t *c, const rows_t *r, const double *v, double *out) {
  whiten_all(c->a1, c->a2, 1.0 / c->sd, r->n, v, out);
  for (int i = 0; i < r->n; i++)
    if (!color_reaches(r, i)) out[i] = 0.0;
}

double color_left(const rows_t *r, const color_t *c, const double *v) {
  double sum = 0.0;
  for (int i = 2; i < r->n; i++) {
    if (!color_reaches(r, i)) continue;
    const double e = (v[i] - c->a1 * v[i - 1] - c->a2 * v[i - 2]) / c->sd;
    sum += e * e;
  }
  return sum;
}
