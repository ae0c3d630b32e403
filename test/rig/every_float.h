// every_float.h - for functions of one float: loops over every float in `make check`, else one in 10,007.
#ifndef TEST_RIG_EVERY_FLOAT_H
#define TEST_RIG_EVERY_FLOAT_H

#include "rig/test.h"

#include <stdint.h>
#include <string.h>

static inline float every_float_of_bits(uint32_t bits) {
  float x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

static inline uint64_t every_float_stride(void) {
  return test_long() ? 1 : 10007;
}

// Head of a `for` loop: x takes all bit patterns in turn, from 0 to the largest, then the negative ones,
// infinities and NaN included.
#define EVERY_FLOAT(x)                                                                                       \
  uint64_t bits = 0, by = every_float_stride();                                                              \
  bits <= UINT32_MAX && ((x) = every_float_of_bits((uint32_t)bits), true);                                   \
  bits += by

// The largest error so far, and where.
typedef struct {
  double error;
  float at;
} worst_t;

// NaN counts as the worst, and stays.
static inline void worst_of(worst_t *w, double error, float at) {
  if (!(error <= w->error) && !isnan(w->error)) *w = (worst_t){error, at};
}

#endif
