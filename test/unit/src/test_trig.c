// test_trig.c - sine and cosine.
#include "flight/trig.h"
#include "rig/test.h"

TEST(sine_and_cosine_are_within_a_millionth) {
  double worst = 0.0;
  for (int i = -100000; i <= 100000; i++) {
    const float x = 1e-4f * (float)i;
    const sincos_t t = trig_sincos(x);
    worst = fmax(worst, fabs((double)t.sin - sin((double)x)));
    worst = fmax(worst, fabs((double)t.cos - cos((double)x)));
  }
  CHECK(worst < 1e-6);
}

TEST(sine_and_cosine_of_what_is_no_angle_are_those_of_zero) {
  static const float x[] = {NAN, INFINITY, -INFINITY, 1e30f};
  for (unsigned i = 0; i < sizeof x / sizeof *x; i++) {
    const sincos_t t = trig_sincos(x[i]);
    CHECK(t.sin == 0.0f && t.cos == 1.0f);
  }
}

TEST(the_angle_of_a_direction_is_within_a_hundred_thousandth) {
  double worst = 0.0;
  for (int i = -3141; i <= 3141; i++) {
    const double x = 1e-3 * i, length = i % 2 ? 1e-3 : 1e3;
    const float got = trig_angle((float)(length * sin(x)), (float)(length * cos(x)));
    worst = fmax(worst, fabs((double)got - x));
  }
  CHECK(worst < 1.2e-5);
  static const float none[][2] = {{0.0f, 0.0f},     {NAN, 1.0f},      {1.0f, NAN},      {NAN, NAN},
                                  {INFINITY, 1.0f}, {1.0f, INFINITY}, {1.0f, -INFINITY}};
  for (unsigned i = 0; i < sizeof none / sizeof *none; i++) {
    const float got = trig_angle(none[i][0], none[i][1]);
    ROW("%u", i);
    CHECK(got == 0.0f);
  }
}

TEST(the_angle_straight_back_is_plus_half_a_turn) {
  CHECK_NEAR(trig_angle(0.0f, -1.0f), 3.1415927, 1e-6);
  CHECK_NEAR(trig_angle(-1e-6f, -1.0f), -3.1415917, 1e-6);
}
