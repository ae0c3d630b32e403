// larger.h - the larger and the smaller of two numbers, as fmax and fmin have it: NaN gives way. Those are
// calls of a library, dozens in each simulated millisecond. Header only.
#ifndef SIM_BASE_LARGER_H
#define SIM_BASE_LARGER_H

#include "base/where.h"

// Of zeros of either sign, the second.
static inline double larger(double a, double b) {
  return where(a > b || b != b, a, b);
}
static inline double smaller(double a, double b) {
  return where(a < b || b != b, a, b);
}

#endif
