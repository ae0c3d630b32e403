// where.h - one of two numbers, without a branch: what takes the place of `? :` on numbers in code that is
// compiled for eight vehicles at a time, too (base/lane.hpp). Header only.
#ifndef SIM_BASE_WHERE_H
#define SIM_BASE_WHERE_H

#include <stdbool.h>

// a where a comparison holds, elsewhere b. Both are computed.
static inline double where(bool holds, double a, double b) {
  return holds ? a : b;
}

// Whether it holds for any of the vehicles that are computed here.
static inline bool any_of(bool holds) {
  return holds;
}

// A number below 2^31 without what is behind its point.
static inline double whole_part(double x) {
  return (int)x;
}

// Element i, a whole number, which may be another one for each vehicle.
static inline double element_at(const double *list, double i) {
  return list[(int)i];
}

#endif
