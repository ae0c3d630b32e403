// clip.h - limits a number to a range.
#ifndef SIM_BASE_CLIP_H
#define SIM_BASE_CLIP_H

#include "base/larger.h"

// x within lo..hi; lo <= hi. NaN becomes lo.
static inline double clip(double x, double lo, double hi) {
  return smaller(larger(x, lo), hi);
}

#endif
