// trig.c - sine, cosine and their inverse.
#include "flight/trig.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

sincos_t trig_sincos(float x_rad) {
  if (!(fabsf(x_rad) <= 1000.0f)) return (sincos_t){0.0f, 1.0f};
  // Reduced by the nearest quarter turns; pi/2 in two parts, so that the remainder keeps its digits.
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

// arctan(x) for x in 0..1: Abramowitz and Stegun 4.4.49, error 1e-5 before rounding.
static float arctan(float x) {
  const float x2 = x * x;
  return x * (0.9998660f + x2 * (-0.3302995f + x2 * (0.1801410f + x2 * (-0.0851330f + x2 * 0.0208351f))));
}

float trig_angle(float sin, float cos) {
  const float s = fabsf(sin), c = fabsf(cos);
  const bool steep = s > c;
  const float longer = steep ? s : c;
  if (!(longer > 0.0f && s <= FLT_MAX && c <= FLT_MAX)) return 0.0f;
  const float first = arctan((steep ? c : s) / longer);
  const float quarter = steep ? 1.5707963f - first : first;
  const float half = cos < 0.0f ? 3.1415927f - quarter : quarter;
  return sin < 0.0f ? -half : half;
}
