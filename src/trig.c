// trig.c - sine and cosine.
#include "flight/trig.h"

#include <math.h>

sincos_t trig_sincos(float x_rad) {
  if (!(fabsf(x_rad) <= 1000.0f)) return (sincos_t){0.0f, 1.0f};
  // To the nearest quarter turn; pi/2 in two parts, so that the rest keeps its digits.
  const float quarters = x_rad * 0.63661977f;
  const int n = (int)(quarters + (quarters < 0.0f ? -0.5f : 0.5f));
  const float r = (x_rad - (float)n * 1.5703125f) - (float)n * 4.8382679e-4f;
  const float r2 = r * r;
  const float s =
      r * (1.0f - r2 * (1.0f / 6.0f) * (1.0f - r2 * (1.0f / 20.0f) * (1.0f - r2 * (1.0f / 42.0f))));
  const float c =
      1.0f -
      r2 * 0.5f * (1.0f - r2 * (1.0f / 12.0f) * (1.0f - r2 * (1.0f / 30.0f) * (1.0f - r2 * (1.0f / 56.0f))));
  switch (n & 3) {
  case 0: return (sincos_t){s, c};
  case 1: return (sincos_t){c, -s};
  case 2: return (sincos_t){-s, -c};
  default: return (sincos_t){-c, s};
  }
}
