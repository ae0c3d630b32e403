// test_ceiling_samples.c - samples of the ceiling's distance: their age, those missed, those that are none.
#include "rig/below.h"
#include "rig/splitmix.h"
#include <string.h>

// Flies up and down at speed_mps between gaps of 45 and 8 cm; the worst error of the estimate.
static double worst_error_m(double speed_mps, int every, int delay, bool age_given, int seed) {
  ceiling_t s;
  ceiling_init(&s, BELOW_PERIOD_S);
  splitmix_t r = {(uint64_t)seed};
  double gap[1000], worst = 0.0;
  double direction = 1.0;
  gap[0] = 0.45;
  for (int k = 1; k < 1000; k++) {
    if (gap[k - 1] < 0.08) direction = -1.0;
    if (gap[k - 1] > 0.45) direction = 1.0;
    const double climb_m = direction * speed_mps * (double)BELOW_PERIOD_S;
    gap[k] = gap[k - 1] - climb_m;
    ceiling_predict(&s, &below_param, (float)climb_m);
    if (k >= delay && k % every == 0 && splitmix_bits(&r) % 8 != 0) { // one in eight is missed
      const float range_m = (float)gap[k - delay], age_s = age_given ? (float)delay * BELOW_PERIOD_S : 0.0f;
      CHECK_OK(ceiling_correct(&s, &below_param, range_m, age_s));
      // One in eight is announced twice.
      if (splitmix_bits(&r) % 8 == 0) CHECK_OK(ceiling_correct(&s, &below_param, range_m, age_s));
    }
    if (s.known) worst = fmax(worst, fabs((double)s.zc_m - gap[k]));
  }
  CHECK(s.known);
  return worst;
}

TEST(ceiling_uses_the_age_of_a_sample) {
  // Faults row 21.
  for (int delay = 5; delay <= 13; delay += 2)
    for (int every = 5; every <= 20; every += 5) {
      ROW("%d ms old, every %d ms", 10 * delay, 10 * every);
      CHECK_NEAR(worst_error_m(0.3, every, delay, true, 3), 0.0, 0.02);
    }
  ROW("130 ms old and taken for new");
  CHECK(worst_error_m(0.3, BELOW_EVERY, 13, false, 3) > 0.03);
}

TEST(ceiling_takes_any_age) {
  static const struct {
    const char *what;
    float age_s;
    double moved_m; // since the sample, at 1 cm per tick
  } row[] = {{"now", 0.0f, 0.0},
             {"one tick", 0.01f, 0.01},
             {"rounded up to ticks", 0.0251f, 0.03},
             {"rounded down to ticks", 0.0249f, 0.02},
             {"31 ticks", 0.31f, 0.31},
             {"too old", 0.4f, 0.31},
             {"1e38", 1e38f, 0.31}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (int ticks = 40; ticks <= 75; ticks += 5) { // the ring's newest is anywhere
      ROW("%s, %d ticks", row[i].what, ticks);
      ceiling_t s;
      ceiling_init(&s, BELOW_PERIOD_S);
      for (int k = 0; k < ticks; k++) ceiling_predict(&s, &below_param, -0.01f);
      CHECK_OK(ceiling_correct(&s, &below_param, 0.1f, row[i].age_s));
      CHECK_NEAR(s.zc_m, 0.1 + row[i].moved_m, 1e-6);
    }
}

TEST(ceiling_refuses_an_age_that_is_none) {
  static const float age_s[] = {NAN, INFINITY, -INFINITY, -0.01f};
  for (unsigned i = 0; i < sizeof age_s / sizeof *age_s; i++) {
    ROW("age %g s", (double)age_s[i]);
    ceiling_t s;
    ceiling_init(&s, BELOW_PERIOD_S);
    CHECK_OK(ceiling_correct(&s, &below_param, 0.3f, 0.0f));
    CHECK_STATUS(ST_BAD_RANGE, ceiling_correct(&s, &below_param, 0.1f, age_s[i]));
    CHECK(s.zc_m == 0.3f);
  }
}

TEST(ceiling_remembers_a_climb_over_missed_periods_as_an_even_one) {
  static const int periods[] = {1, 7, 31, 32, 33, 500};
  for (unsigned i = 0; i < sizeof periods / sizeof *periods; i++) {
    ROW("%d periods", periods[i]);
    const int n = periods[i];
    ceiling_t once, even;
    ceiling_init(&once, BELOW_PERIOD_S);
    ceiling_init(&even, BELOW_PERIOD_S);
    CHECK_OK(ceiling_correct(&once, &below_param, 0.45f, 0.0f));
    CHECK_OK(ceiling_correct(&even, &below_param, 0.45f, 0.0f));
    ceiling_predict_over(&once, &below_param, 0.2f, n);
    for (int k = 0; k < n; k++) ceiling_predict(&even, &below_param, 0.2f / (float)n);
    CHECK_NEAR(once.zc_m, even.zc_m, 1e-4);
    CHECK_NEAR(once.blind_s, even.blind_s, 1e-3);
  }
}

TEST(ceiling_keeps_its_estimate_when_a_sample_is_no_distance) {
  // Faults rows 13, 14, 22.
  static const struct {
    const char *what;
    float range_m;
  } row[] = {{"no echo", 32.767f},
             {"never started", 0.0f},
             {"minus zero", -0.0f},
             {"negative", -0.3f},
             {"nan", NAN},
             {"infinite", INFINITY},
             {"minus infinite", -INFINITY},
             {"millimetres", 300.0f},
             {"1e38", 1e38f},
             {"beyond the sensor", 4.01f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ceiling_t s = below_ceiling(0.3f);
    for (int k = 0; k < 5; k++) ceiling_predict(&s, &below_param, 0.01f);
    const ceiling_t before = s;
    CHECK_STATUS(ST_BAD_RANGE, ceiling_correct(&s, &below_param, row[i].range_m, 0.0f));
    CHECK(memcmp(&s, &before, sizeof s) == 0);
    ROW("%s, first of all", row[i].what);
    ceiling_init(&s, BELOW_PERIOD_S);
    CHECK_STATUS(ST_BAD_RANGE, ceiling_correct(&s, &below_param, row[i].range_m, 0.0f));
    CHECK(!s.known);
  }
}

TEST(ceiling_is_not_made_known_by_a_sample_that_is_not_believed) {
  static const float range_m[] = {0.0003f, 0.01f, 0.0499f}; // the first: 0.3 m in kilometres, so to speak
  for (unsigned i = 0; i < sizeof range_m / sizeof *range_m; i++) {
    ROW("%g m", (double)range_m[i]);
    ceiling_t s;
    ceiling_init(&s, BELOW_PERIOD_S);
    for (int k = 0; k < 10; k++) below_hover_and_look(&s, range_m[i]);
    CHECK(!s.known);
    ROW("%g m, after a ceiling that went out of sight", (double)range_m[i]);
    s = below_ceiling(0.4f);
    for (int k = 0; k < 20; k++) ceiling_predict(&s, &below_param, -0.01f);
    for (int k = 0; k < 10; k++) below_hover_and_look(&s, range_m[i]);
    CHECK(!s.known);
  }
}
