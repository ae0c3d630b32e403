// test_decay.c - exp(-x) of the plant, against the C library's in extended precision.
#include "plant/decay.h"
#include "rig/test.h"

TEST(decay_is_exp_to_two_ulp) {
  static const double to[] = {1e-3, 1.0, 40.0, 699.0};
  for (int row = 0; row < 4; row++) {
    double worst = 0.0;
    for (int i = 0; i <= 100000; i++) {
      const double x = to[row] * i / 1e5;
      const long double want = expl(-(long double)x);
      const double ulp = nextafter((double)want, 2.0) - (double)want;
      const few_t got = decay(1.0, 1.0, (few_t){x, 0.5 * x});
      worst = fmax(worst, fabs((double)((long double)got[0] - want)) / ulp);
      if (i % 100 == 0) CHECK(got[1] == decay(1.0, 1.0, few_all(0.5 * x))[0]); // neighbours do not matter
    }
    ROW("up to %g", to[row]);
    CHECK(worst <= 2.0);
  }
}

TEST(decay_begins_at_its_factor_falls_by_its_rate_and_ends_at_zero) {
  const few_t ends = decay(0.44, 80.0, (few_t){0.0, HUGE_VAL});
  CHECK(ends[0] == 0.44 && ends[1] == 0.0);
  CHECK_NEAR(decay(0.44, 80.0, few_all(0.02))[0], 0.44 * exp(-1.6), 1e-16);
  CHECK(decay(1.0, 1e3, few_all(0.701))[0] == 0.0);
}

TEST(a_few_at_a_time_give_what_one_at_a_time_gives) {
  static const double at[] = {-1.0, -0.0, 0.0, 0.5, 3.0, HUGE_VAL, (double)NAN};
  const int n = sizeof at / sizeof *at;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      const double p[FEW_N] = {at[i], at[j], at[j], at[i]};
      const few_t a = few_of(p), two = few_all(2.0);
      ROW("%g, %g", at[i], at[j]);
      for (int k = 0; k < FEW_N; k++) {
        CHECK(few_min(a, two)[k] == (p[k] < 2.0 ? p[k] : 2.0));
        CHECK(few_max(a, two)[k] == (p[k] > 2.0 ? p[k] : 2.0));
        CHECK(pair_min(pair_of(p), pair_both(2.0))[k % 2] == (p[k % 2] < 2.0 ? p[k % 2] : 2.0));
        if (p[k] >= 0.0) CHECK(few_sqrt(a)[k] == sqrt(p[k]));
      }
    }
}
