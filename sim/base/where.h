// where.h - choices between numbers without a branch, instead of `? :`, in code that is also compiled for
// eight vehicles at a time (base/lane.hpp). Header only.
#ifndef SIM_BASE_WHERE_H
#define SIM_BASE_WHERE_H

#include <stdbool.h>

// a where the condition holds, elsewhere b. Both are computed.
static inline double where(bool holds, double a, double b) {
  return holds ? a : b;
}

// True if the condition holds for any of the vehicles that are computed here.
static inline bool any_of(bool holds) {
  return holds;
}

// The number, below 2^31, truncated to a whole number.
static inline double whole_part(double x) {
  return (int)x;
}

// Element i, a whole number, which may differ from vehicle to vehicle.
static inline double element_at(const double *list, double i) {
  return list[(int)i];
}

#endif
