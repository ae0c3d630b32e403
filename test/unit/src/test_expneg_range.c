// test_expneg_range.c - exp(-x) of every float.
#include "flight/expneg.h"
#include "rig/every_float.h"

TEST(expneg_of_every_float_is_within_its_error_or_its_end) {
  worst_t worst = {0.0, 0.0f};
  uint64_t ends_wrong = 0;
  float x;
  for (EVERY_FLOAT(x)) {
    const float got = expneg(x);
    if (x > 0.0f && x <= 87.0f) {
      const double want = exp(-(double)x);
      worst_of(&worst, fabs((double)got - want) / ldexp(1.0, ilogb(want) - 23), x);
    } else {
      ends_wrong += got != (x > 87.0f ? 0.0f : 1.0f);
    }
  }
  ROW("worst at %.9g", (double)worst.at);
  // One in 10,007 stays below 0.9; with a coefficient off by a tenth it is 0.98.
  CHECK_NEAR(worst.error, 0.0, test_long() ? 1.03 : 0.9);
  CHECK(ends_wrong == 0);
}
