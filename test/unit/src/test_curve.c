// test_curve.c - which curve the controller believes, and its bounds.
#include "flight/curve.h"
#include "rig/bells.h"
#include "rig/test.h"

#include <float.h>
#include <string.h>

// The fixed curve is the golden one, the live one 1.2 + 0.1 bell(0), so that they can be told apart.
static const rbf_weights_t LIVE = {{1.2f, 0.1f, 0, 0, 0, 0, 0}};

static curve_param_t plain_curve(int32_t mode) {
  return (curve_param_t){.mode = mode,
                         .ca = 0.44f,
                         .cb_per_m = 80.0f,
                         .on_m = 0.1f,
                         .clip = 0,
                         .ratio_min = 0.5f,
                         .ratio_max = 3.0f,
                         .fixed = bells_golden_weights()};
}

static bool is_free_air(rbf_point_t at) {
  static const rbf_point_t want = {.ratio = 1.0f, .slope_per_m = 0.0f};
  return memcmp(&at, &want, sizeof at) == 0;
}

TEST(curve_mode_says_which_weights_are_believed) {
  const double z = 0.02;
  const rbf_weights_t fixed = bells_golden_weights();
  const struct {
    const char *what;
    int32_t mode;
    double ratio, slope;
  } row[] = {
      {"off", CURVE_OFF, 1.0, 0.0},
      {"fixed", CURVE_FIXED, bells_ratio(&fixed, z), bells_slope(&fixed, z)},
      {"live", CURVE_LIVE, bells_ratio(&LIVE, z), bells_slope(&LIVE, z)},
      {"theory", CURVE_THEORY, bells_theory(0.44, 80, z), -80.0 * 0.44 * exp(-80.0 * z)},
      {"no mode", 4, 1.0, 0.0},
      {"no mode either", -1, 1.0, 0.0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const curve_param_t p = plain_curve(row[i].mode);
    const rbf_point_t at = curve_at(&p, &LIVE, true, (float)z);
    CHECK_NEAR(at.ratio, row[i].ratio, 2e-6);
    CHECK_NEAR(at.slope_per_m, row[i].slope, 5e-4);
  }
}

TEST(curve_is_free_air_to_the_bit_where_no_ceiling_acts) {
  static const struct {
    const char *what;
    bool known, free;
    float zc_m, on_m;
  } row[] = {
      {"unknown, near", false, true, 0.02f, 0.1f},
      {"unknown, contact", false, true, 0.0f, 0.1f},
      {"unknown, nan", false, true, NAN, 0.1f},
      {"known, near", true, false, 0.02f, 0.1f},
      {"known, just within", true, false, 0.0999f, 0.1f},
      {"known, at the switch", true, true, 0.1f, 0.1f},
      {"known, far", true, true, 0.3f, 0.1f},
      {"known, nan", true, true, NAN, 0.1f},
      {"known, switch moved out", true, false, 0.3f, 0.5f},
      {"known, switched off", true, true, 0.0f, 0.0f},
  };
  for (int32_t mode = CURVE_FIXED; mode <= CURVE_THEORY; mode++)
    for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
      ROW("mode %d: %s", (int)mode, row[i].what);
      curve_param_t p = plain_curve(mode);
      p.on_m = row[i].on_m;
      CHECK(is_free_air(curve_at(&p, &LIVE, row[i].known, row[i].zc_m)) == row[i].free);
    }
}

TEST(curve_clip_takes_the_rising_tail_and_the_ratio_below_1) {
  curve_param_t p = plain_curve(CURVE_FIXED);
  ROW("rising tail at 9 cm, not clipped");
  CHECK(curve_at(&p, &LIVE, true, 0.09f).slope_per_m > 0.5f);
  p.clip = 1;
  ROW("rising tail at 9 cm, clipped");
  CHECK(curve_at(&p, &LIVE, true, 0.09f).slope_per_m == 0.0f);
  ROW("falling part is kept");
  CHECK_NEAR(curve_at(&p, &LIVE, true, 0.02f).slope_per_m, -6.742, 6e-4);
  CHECK_NEAR(curve_at(&p, &LIVE, true, 0.02f).ratio, 1.0941, 2e-6);
  p.fixed = (rbf_weights_t){{0.9f, 0, 0, 0, 0, 0, 0}};
  ROW("ratio 0.9, clipped");
  CHECK(curve_at(&p, &LIVE, true, 0.02f).ratio == 1.0f);
  p.clip = 0;
  ROW("ratio 0.9, not clipped");
  CHECK(curve_at(&p, &LIVE, true, 0.02f).ratio == 0.9f);
  p = plain_curve(CURVE_THEORY);
  p.clip = 1;
  for (int mm = 0; mm < 100; mm++) {
    ROW("theory is not touched at %d mm", mm);
    const float z = 1e-3f * (float)mm;
    CHECK_NEAR(curve_at(&p, &LIVE, true, z).ratio, bells_theory(0.44, 80, (double)z), 1e-6);
    CHECK(curve_at(&p, &LIVE, true, z).slope_per_m < 0.0f);
  }
}

TEST(curve_stays_in_its_bounds_whatever_the_weights_say) {
  // Faults row 37. A bound that acts has no slope: where the curve is not believed, nor is its slope.
  static const struct {
    const char *what;
    rbf_weights_t w;
    int32_t clip;
    float ratio;
  } row[] = {
      {"all -5", {{-5, -5, -5, -5, -5, -5, -5}}, 0, 0.5f},
      {"all -5, clipped", {{-5, -5, -5, -5, -5, -5, -5}}, 1, 1.0f},
      {"bells -5, clipped", {{1, -5, -5, -5, -5, -5, -5}}, 1, 1.0f},
      {"constant 0", {{0, 0, 0, 0, 0, 0, 0}}, 0, 0.5f},
      {"all 5", {{5, 5, 5, 5, 5, 5, 5}}, 0, 3.0f},
      {"all 5, clipped", {{5, 5, 5, 5, 5, 5, 5}}, 1, 3.0f},
      {"nan", {{NAN, 0, 0, 0, 0, 0, 0}}, 0, 0.5f},
      {"infinite", {{INFINITY, 0, 0, 0, 0, 0, 0}}, 0, 3.0f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (int32_t mode = CURVE_FIXED; mode <= CURVE_LIVE; mode++)
      for (int mm = 4; mm <= 26; mm += 2) {
        ROW("%s, mode %d, %d mm", row[i].what, (int)mode, mm);
        curve_param_t p = plain_curve(mode);
        p.clip = row[i].clip;
        p.fixed = row[i].w;
        const rbf_point_t at = curve_at(&p, &row[i].w, true, 1e-3f * (float)mm);
        CHECK(at.ratio == row[i].ratio);
        CHECK(at.slope_per_m == 0.0f);
      }
}

TEST(curve_that_just_reaches_a_bound_keeps_its_slope) {
  curve_param_t p = plain_curve(CURVE_FIXED);
  const rbf_point_t free = curve_at(&p, &LIVE, true, 0.02f);
  static const struct {
    const char *what;
    float min, max; // of the ratio
    bool kept;
  } row[] = {
      {"the least is its own", 1.0f, 2.0f, true},
      {"the least is above it", 1.0001f, 2.0f, false},
      {"the largest is its own", 0.5f, 1.0f, true},
      {"the largest is below it", 0.5f, 0.9999f, false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    p.ratio_min = row[i].min * free.ratio;
    p.ratio_max = row[i].max * free.ratio;
    CHECK(curve_at(&p, &LIVE, true, 0.02f).slope_per_m == (row[i].kept ? free.slope_per_m : 0.0f));
  }
}

TEST(curve_is_finite_for_every_finite_distance) {
  static const float z[] = {-FLT_MAX, -1e10f, -1.0f, -0.0f, 0.0f, FLT_MIN, 1.0f, FLT_MAX};
  for (int32_t mode = CURVE_OFF; mode <= CURVE_THEORY; mode++)
    for (unsigned i = 0; i < sizeof z / sizeof *z; i++) {
      ROW("mode %d at %g m", (int)mode, (double)z[i]);
      curve_param_t p = plain_curve(mode);
      p.on_m = 0.5f;
      const rbf_point_t at = curve_at(&p, &LIVE, true, z[i]);
      CHECK(isfinite(at.ratio) && isfinite(at.slope_per_m));
    }
}
