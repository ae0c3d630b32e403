// lowpass.c - second-order Butterworth low-pass.
#include "base/lowpass.h"

#include <math.h>

void lowpass_init_q(lowpass_t *s, double cutoff_Hz, double rate_Hz, double two_zeta, double value) {
  const double pi = acos(-1.0);
  const double k = tan(pi * cutoff_Hz / rate_Hz);
  const double n = 1.0 + two_zeta * k + k * k;
  *s = (lowpass_t){
      .b = k * k / n,
      .a1 = 2.0 * (k * k - 1.0) / n,
      .a2 = (1.0 - two_zeta * k + k * k) / n,
      .x1 = value,
      .x2 = value,
      .y1 = value,
      .y2 = value,
  };
}

void lowpass_init(lowpass_t *s, double cutoff_Hz, double rate_Hz, double value) {
  lowpass_init_q(s, cutoff_Hz, rate_Hz, sqrt(2.0), value);
}

double lowpass_step(lowpass_t *s, double x) {
  const double y = s->b * (x + 2.0 * s->x1 + s->x2) - s->a1 * s->y1 - s->a2 * s->y2;
  s->x2 = s->x1;
  s->x1 = x;
  s->y2 = s->y1;
  s->y1 = y;
  return y;
}
