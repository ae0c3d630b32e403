// test_trig_range.c - sine, cosine and the angle of every float.
#include "flight/trig.h"
#include "rig/every_float.h"

TEST(sines_of_every_float_are_within_their_error_and_of_length_one) {
  worst_t worst = {0.0, 0.0f}, length = {0.0, 0.0f};
  uint64_t ends_wrong = 0;
  float x;
  for (EVERY_FLOAT(x)) {
    const sincos_t t = trig_sincos(x);
    if (!(fabsf(x) <= 1000.0f)) {
      ends_wrong += t.sin != 0.0f || t.cos != 1.0f;
      continue;
    }
    const double sin_off = (double)t.sin - sin((double)x), cos_off = (double)t.cos - cos((double)x);
    worst_of(&worst, fmax(fabs(sin_off), fabs(cos_off)), x);
    worst_of(&length, fabs((double)t.sin * (double)t.sin + (double)t.cos * (double)t.cos - 1.0), x);
  }
  ROW("worst at %.9g, length at %.9g", (double)worst.at, (double)length.at);
  CHECK_NEAR(worst.error, 0.0, 4e-7);
  CHECK_NEAR(length.error, 0.0, 6e-7);
  CHECK(ends_wrong == 0);
}

TEST(angle_of_every_slope_is_within_a_hundred_thousandth) {
  worst_t worst = {0.0, 0.0f};
  float slope;
  for (EVERY_FLOAT(slope)) {
    if (!(fabsf(slope) <= 1.0f)) continue;
    const double want = atan((double)slope);
    worst_of(&worst, fabs((double)trig_angle(slope, 1.0f) - want), slope);
    worst_of(&worst, fabs((double)trig_angle(1.0f, slope) + want - 1.57079632679489662), slope);
  }
  ROW("worst at %.9g", (double)worst.at);
  CHECK_NEAR(worst.error, 0.0, 1.2e-5);
}
