// test_expneg.c - exp(-x) against the library's double.
#include "flight/expneg.h"
#include "rig/test.h"

#include <float.h>
#include <stdint.h>
#include <string.h>

static float float_of_bits(uint32_t bits) {
  float x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

static uint32_t bits_of_float(float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

// How many steps of float got is away from want.
static double ulp(float got, double want) {
  return fabs((double)got - want) / ldexp(1.0, ilogb(want) - 23);
}

TEST(expneg_is_within_its_error_of_exp_from_0_to_87) {
  double worst = 0.0;
  float worst_x = 0.0f;
  for (uint32_t bits = bits_of_float(1e-9f); bits <= bits_of_float(87.0f); bits += 211) {
    const float x = float_of_bits(bits);
    const double off = ulp(expneg(x), exp(-(double)x));
    if (off > worst) {
      worst = off;
      worst_x = x;
    }
  }
  ROW("worst at x = %.9g", (double)worst_x);
  CHECK_NEAR(worst, 0.0, 1.03);
}

TEST(expneg_takes_the_nearer_power_of_two) {
  // x = (n + just under 1/2) ln 2: with n the result is the nearest float to exp(-x), with n + 1 its
  // neighbour.
  static const struct {
    float x, want;
  } row[] = {
      {5.1722641f, 0x1.73b38ep-8f},   {5.88481951f, 0x1.6c8e9p-9f},   {6.57796669f, 0x1.6c8e9p-10f},
      {16.2584591f, 0x1.754038p-24f}, {20.4429893f, 0x1.6bccbap-30f}, {27.3481236f, 0x1.758236p-40f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%.9g", (double)row[i].x);
    CHECK(row[i].want == (float)exp(-(double)row[i].x));
    CHECK(expneg(row[i].x) == row[i].want);
  }
}

TEST(expneg_never_rises) {
  // Equally spaced: two neighbours differ by more than the rounding does, except where both are 1.
  int rises = 0;
  float last = 1.0f;
  for (int i = 0; i <= 870000; i++) {
    const float y = expneg(1e-4f * (float)i);
    if (!(y <= last)) rises++;
    last = y;
  }
  CHECK(rises == 0);
}

TEST(expneg_has_defined_ends) {
  static const struct {
    const char *what;
    float x, want;
  } row[] = {
      {"zero", 0.0f, 1.0f},
      {"minus zero", -0.0f, 1.0f},
      {"smallest subnormal", 1e-45f, 1.0f},
      {"negative", -1.0f, 1.0f},
      {"largest negative", -FLT_MAX, 1.0f},
      {"minus infinity", -INFINITY, 1.0f},
      {"nan", NAN, 1.0f},
      {"just beyond 87", 87.00001f, 0.0f},
      {"largest", FLT_MAX, 0.0f},
      {"infinity", INFINITY, 0.0f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK(expneg(row[i].x) == row[i].want);
  }
  ROW("87");
  CHECK(expneg(87.0f) >= FLT_MIN);
}
