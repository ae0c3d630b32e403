// larger.h - the larger and the smaller of two numbers; where one is NaN, the other, as in fmax and fmin.
// Those are library calls, and each simulated millisecond needs dozens. Header only.
#ifndef SIM_BASE_LARGER_H
#define SIM_BASE_LARGER_H

#include "base/where.h"

// Of two zeros, the second, whatever their signs.
static inline double larger(double a, double b) {
  return where(a > b || b != b, a, b);
}
static inline double smaller(double a, double b) {
  return where(a < b || b != b, a, b);
}

#endif
