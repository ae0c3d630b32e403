// expneg.c - exp(-x) for x >= 0.
#include "flight/expneg.h"

#include "flight/v3.h"
#include <stdint.h>
#include <string.h>

float expneg(float x) {
  const bool some = x > 0.0f, all = x > 87.0f;
  if (!ANY(some)) return 1.0f;
  if (!ANY(!all)) return 0.0f;

  const int n = (int)(x * 1.44269504f + 0.5f);
  // ln 2 in two parts: n times the first is exact, so that r keeps all its digits.
  const float r = ((float)n * 0.693359375f - x) + (float)n * -2.12194440e-4f;

  float p = 1.0f / 5040.0f;
  p = p * r + 1.0f / 720.0f;
  p = p * r + 1.0f / 120.0f;
  p = p * r + 1.0f / 24.0f;
  p = p * r + 1.0f / 6.0f;
  p = p * r + 0.5f;
  const float exp_r = p * (r * r) + r + 1.0f;

  const uint32_t bits = (uint32_t)(127 - n) << 23; // 2^-n, n <= 126
  float scale;
  memcpy(&scale, &bits, sizeof scale);
  return EITHER(some, EITHER(all, 0.0f, exp_r * scale), 1.0f);
}
