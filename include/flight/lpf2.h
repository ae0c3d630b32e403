// lpf2.h - second-order Butterworth low-pass: the one filter that all signals of the outer loop share.
//
// Bilinear transform, prewarped at the cut-off: with k = tan(pi f / fs), n = 1 + sqrt(2) k + k^2,
//   y = b0 (x + 2 x1 + x2) - a1 y1 - a2 y2,  b0 = k^2/n,  a1 = 2 (k^2 - 1)/n,  a2 = (1 - sqrt(2) k + k^2)/n.
// Signals that are compared in an incremental law must have passed the same filter (thesis section 3.2).
#ifndef FLIGHT_LPF2_H
#define FLIGHT_LPF2_H

#include "flight/status.h"
#include "flight/v3.h"

typedef struct {
  float b0, b1, b2, a1, a2; // no unit
} lpf2_coef_t;

// The last two inputs and outputs. They mean the same under any coefficients, so the cut-off may
// change in flight without a bump.
typedef struct {
  float x1, x2, y1, y2;
} lpf2_t;

// Computes the coefficients. cutoff_Hz: 0 (no filter: output = input), or 0.001 to 0.45 times rate_Hz (lower,
// the poles are too near 1 for a float). rate_Hz: > 0 to 1e5. ST_BAD_PARAM: outside of these ranges, or not
// finite; *c is kept.
MUST_CHECK status_t lpf2_tune(lpf2_coef_t *c, float cutoff_Hz, float rate_Hz);

// Returns the delay of a slow signal in s: sqrt(2) / (2 pi) of the cut-off's period; 0 without a filter.
static inline float lpf2_delay_s(float cutoff_Hz) {
  return cutoff_Hz > 0.0f ? 0.2251f / cutoff_Hz : 0.0f;
}

// Sets the state as if the input had always been `value`.
void lpf2_reset(lpf2_t *s, float value);

// Returns the sum of the state. After a bit flip in the state it is huge or NaN: from 1e30 a filter recovers
// late, from NaN never.
static inline float lpf2_sum(const lpf2_t *s) {
  return s->x1 + s->x2 + s->y1 + s->y2;
}

// Filters one sample. In the header, because a call costs half as much as the filter.
static ALWAYS_INLINE float lpf2_step(lpf2_t *s, const lpf2_coef_t *c, float x) {
  const float y = c->b0 * x + c->b1 * s->x1 + c->b2 * s->x2 - c->a1 * s->y1 - c->a2 * s->y2;
  s->x2 = s->x1;
  s->x1 = x;
  s->y2 = s->y1;
  s->y1 = y;
  return y;
}

// Filters three signals, each with its own state.
static ALWAYS_INLINE v3_t lpf2_step3(lpf2_t s[3], const lpf2_coef_t *c, v3_t x) {
  const lpf2_coef_t k = *c; // a copy, or the compiler would read *c again after every write to a state
  const float first = lpf2_step(&s[0], &k, x.x), second = lpf2_step(&s[1], &k, x.y);
  return (v3_t){first, second, lpf2_step(&s[2], &k, x.z)};
}

#endif
