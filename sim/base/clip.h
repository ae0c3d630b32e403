// clip.h - a number, or the bound that it is beyond.
#ifndef SIM_BASE_CLIP_H
#define SIM_BASE_CLIP_H

#include "base/larger.h"

// lo <= hi. NaN becomes lo.
static inline double clip(double x, double lo, double hi) {
  return smaller(larger(x, lo), hi);
}

#endif
