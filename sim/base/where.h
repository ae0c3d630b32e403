// where.h - one of two numbers, without a branch: what takes the place of `? :` on numbers in code that is
// compiled for eight vehicles at a time, too (base/lane.hpp). Header only.
#ifndef SIM_BASE_WHERE_H
#define SIM_BASE_WHERE_H

#include <stdbool.h>

// a where a comparison holds, elsewhere b. Both are computed.
static inline double where(bool holds, double a, double b) {
  return holds ? a : b;
}

#endif
