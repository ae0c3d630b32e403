// lpf2.c - second-order Butterworth low-pass.
#include "flight/lpf2.h"

// tan(x) for 0 <= x <= 0.45 pi by Lambert's continued fraction, good to float rounding there:
// tan x = x / (1 - x^2/(3 - x^2/(5 - ...))).
static float tan_lambert(float x) {
  const float x2 = x * x;
  float d = 17.0f;
  for (int odd = 15; odd >= 1; odd -= 2) d = (float)odd - x2 / d;
  return x / d;
}

status_t lpf2_tune(lpf2_coef_t *c, float cutoff_Hz, float rate_Hz) {
  if (!(rate_Hz > 0.0f && rate_Hz <= 1e5f)) return ST_BAD_PARAM;
  if (!(cutoff_Hz >= 0.0f && cutoff_Hz <= 0.45f * rate_Hz)) return ST_BAD_PARAM;
  if (cutoff_Hz > 0.0f && cutoff_Hz < 1e-3f * rate_Hz) return ST_BAD_PARAM;
  if (!(cutoff_Hz > 0.0f)) {
    *c = (lpf2_coef_t){.b0 = 1.0f};
    return ST_OK;
  }
  const float k = tan_lambert(3.14159265f * cutoff_Hz / rate_Hz);
  const float k2 = k * k;
  const float inv_n = 1.0f / (1.0f + 1.41421356f * k + k2);
  const float b0 = k2 * inv_n;
  *c = (lpf2_coef_t){
      .b0 = b0,
      .b1 = 2.0f * b0,
      .b2 = b0,
      .a1 = 2.0f * (k2 - 1.0f) * inv_n,
      .a2 = (1.0f - 1.41421356f * k + k2) * inv_n,
  };
  return ST_OK;
}

void lpf2_reset(lpf2_t *s, float value) {
  *s = (lpf2_t){value, value, value, value};
}
