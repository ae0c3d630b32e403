// test_trig.c - sine and cosine.
#include "flight/trig.h"
#include "test.h"

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
