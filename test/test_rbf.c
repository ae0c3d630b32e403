// test_rbf.c - the curve, its fit to the theory, and which curve the controller believes.
#include "flight/curve.h"
#include "flight/rbf.h"
#include "oracle.h"
#include "random.h"
#include "test.h"

#include <float.h>
#include <string.h>

// Acceptance P2: ordinary least squares to 1 + 0.44 exp(-80 z) on 21 points.
static const double GOLDEN[RBF_N] = {1.43142386,  0.15021046,  -0.09754395, -0.07601899,
                                     -0.26694495, -0.30407099, -0.37406497};

static rbf_weights_t golden(void) {
  rbf_weights_t w;
  for (int i = 0; i < RBF_N; i++) w.w[i] = (float)GOLDEN[i];
  return w;
}

// Thesis eq. 22 and section 5.2, written down a second time in double.
static void basis_of(double z, double basis[RBF_N]) {
  static const double width[RBF_N] = {0, 15000, 10000, 5000, 2000, 1250, 1000};
  static const double centre[RBF_N] = {0, 0, 0.005, 0.015, 0.03, 0.06, 0.1};
  for (int i = 0; i < RBF_N; i++) basis[i] = exp(-width[i] * (z - centre[i]) * (z - centre[i]));
}

static double ratio_of(const rbf_weights_t *w, double z) {
  double basis[RBF_N], sum = 0.0;
  basis_of(z, basis);
  for (int i = 0; i < RBF_N; i++) sum += (double)w->w[i] * basis[i];
  return sum;
}

static double slope_of(const rbf_weights_t *w, double z) {
  const double h = 1e-6;
  return (ratio_of(w, z + h) - ratio_of(w, z - h)) / (2.0 * h);
}

static double theory(double ca, double cb, double z) {
  return 1.0 + ca * exp(-cb * z);
}

// The exact weights for 1 + ca exp(-cb z) on 21 points.
static void fit_exactly(double ca, double cb, double w[RBF_N]) {
  double rows[21][RBF_N], y[21];
  for (int i = 0; i <= 20; i++) {
    basis_of(0.005 * i, rows[i]);
    y[i] = theory(ca, cb, 0.005 * i);
  }
  oracle_least_squares(21, (const double(*)[RBF_N])rows, y, w);
}

TEST(rbf_gives_the_golden_values_and_slopes) {
  static const struct {
    double z, ratio, slope;
  } row[] = {
      {0.00, 1.433467, -17.104}, {0.01, 1.188467, -17.099}, {0.02, 1.094100, -6.742},
      {0.03, 1.038108, -3.998},  {0.05, 1.012265, -0.125},  {0.10, 1.016193, 4.119},
  };
  const rbf_weights_t w = golden();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m", row[i].z);
    const rbf_point_t at = rbf_at(&w, (float)row[i].z);
    CHECK_NEAR(at.ratio, row[i].ratio, 1e-6);
    CHECK_NEAR(at.slope_per_m, row[i].slope, 6e-4);
  }
}

TEST(rbf_slope_is_the_finite_difference_of_the_value) {
  random_t r = {2};
  for (int set = 0; set < 20; set++) {
    rbf_weights_t w;
    for (int i = 0; i < RBF_N; i++) w.w[i] = (float)random_between(&r, -1.0, 1.0);
    for (int mm = -20; mm <= 250; mm++) {
      const float z = 1e-3f * (float)mm;
      ROW("set %d at %d mm", set, mm);
      const rbf_point_t at = rbf_at(&w, z);
      CHECK_NEAR(at.ratio, ratio_of(&w, (double)z), 2e-6);
      CHECK_NEAR(at.slope_per_m, slope_of(&w, (double)z), 5e-4);
    }
  }
}

TEST(rbf_is_its_constant_far_away) {
  static const float z[] = {0.5f, 4.0f, -4.0f, 1e10f, -1e10f, FLT_MAX, -FLT_MAX};
  const rbf_weights_t w = golden();
  for (unsigned i = 0; i < sizeof z / sizeof *z; i++) {
    ROW("%g m", (double)z[i]);
    const rbf_point_t at = rbf_at(&w, z[i]);
    CHECK(at.ratio == w.w[0]);
    CHECK(at.slope_per_m == 0.0f);
  }
}

TEST(rbf_golden_weights_are_the_least_squares_fit) {
  double w[RBF_N];
  fit_exactly(0.44, 80.0, w);
  for (int i = 0; i < RBF_N; i++) {
    ROW("w%d", i + 1);
    CHECK_NEAR(w[i], GOLDEN[i], 6e-9); // to the last digit that is printed
  }
}

TEST(rbf_fit_has_condition_115) {
  double square[RBF_N][RBF_N] = {{0}}, values[RBF_N];
  for (int k = 0; k <= 20; k++) {
    double basis[RBF_N];
    basis_of(0.005 * k, basis);
    for (int i = 0; i < RBF_N; i++)
      for (int j = 0; j < RBF_N; j++) square[i][j] += basis[i] * basis[j];
  }
  oracle_eigenvalues((const double(*)[RBF_N])square, values);
  CHECK_NEAR(sqrt(values[RBF_N - 1] / values[0]), 115.0, 0.5);
}

TEST(rbf_fits_the_theory_as_the_exact_solution_does) {
  static const struct {
    double ca, cb;
  } row[] = {{0.44, 80}, {0.6, 80}, {0.25, 80}, {0.44, 59}, {0.44, 160}, {5, 80}, {0.44, 1}, {0, 80}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("ca %g cb %g", row[i].ca, row[i].cb);
    double exact[RBF_N];
    fit_exactly(row[i].ca, row[i].cb, exact);
    rbf_weights_t w;
    CHECK_OK(rbf_fit_theory(&w, (float)row[i].ca, (float)row[i].cb));
    const double tol = row[i].ca <= 1.0 ? 1e-3 : 1e-3 * row[i].ca;
    for (int k = 0; k < RBF_N; k++) CHECK_NEAR(w.w[k], exact[k], tol);
  }
  ROW("golden");
  rbf_weights_t w;
  CHECK_OK(rbf_fit_theory(&w, 0.44f, 80.0f));
  for (int k = 0; k < RBF_N; k++) CHECK_NEAR(w.w[k], GOLDEN[k], 1e-3);
}

TEST(rbf_fit_is_as_far_from_the_theory_as_the_prototype_was) {
  rbf_weights_t w;
  CHECK_OK(rbf_fit_theory(&w, 0.44f, 80.0f));
  double max_5mm = 0.0, max_1mm = 0.0, square = 0.0;
  for (int i = 0; i <= 1000; i++) { // 0.1 mm: on a coarser grid the ends weigh too much in the rms
    const double z = 1e-4 * i;
    const double error = (double)rbf_at(&w, (float)z).ratio - theory(0.44, 80.0, z);
    if (i % 10 == 0) max_1mm = fmax(max_1mm, fabs(error));
    if (i % 50 == 0) max_5mm = fmax(max_5mm, fabs(error));
    square += error * error;
  }
  CHECK_NEAR(max_5mm, 1.60e-2, 5e-5);
  CHECK_NEAR(max_1mm, 1.84e-2, 5e-5);
  CHECK_NEAR(sqrt(square / 1001.0), 5.8e-3, 5e-5);
}

TEST(rbf_fit_rejects_what_is_no_theory) {
  static const struct {
    const char *what;
    float ca, cb;
  } row[] = {
      {"ca negative", -0.01f, 80.0f},   {"ca too large", 5.1f, 80.0f}, {"ca nan", NAN, 80.0f},
      {"ca infinite", INFINITY, 80.0f}, {"cb zero", 0.44f, 0.0f},      {"cb negative", 0.44f, -80.0f},
      {"cb too large", 0.44f, 1001.0f}, {"cb nan", 0.44f, NAN},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    rbf_weights_t w = golden();
    const rbf_weights_t before = w;
    CHECK_STATUS(ST_BAD_PARAM, rbf_fit_theory(&w, row[i].ca, row[i].cb));
    CHECK(memcmp(&w, &before, sizeof w) == 0);
  }
}

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
                         .fixed = golden()};
}

static bool is_free_air(rbf_point_t at) {
  static const rbf_point_t want = {.ratio = 1.0f, .slope_per_m = 0.0f};
  return memcmp(&at, &want, sizeof at) == 0;
}

TEST(curve_mode_says_which_weights_are_believed) {
  const double z = 0.02;
  const rbf_weights_t fixed = golden();
  const struct {
    const char *what;
    int32_t mode;
    double ratio, slope;
  } row[] = {
      {"off", CURVE_OFF, 1.0, 0.0},
      {"fixed", CURVE_FIXED, ratio_of(&fixed, z), slope_of(&fixed, z)},
      {"live", CURVE_LIVE, ratio_of(&LIVE, z), slope_of(&LIVE, z)},
      {"theory", CURVE_THEORY, theory(0.44, 80, z), -80.0 * 0.44 * exp(-80.0 * z)},
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
    CHECK_NEAR(curve_at(&p, &LIVE, true, z).ratio, theory(0.44, 80, (double)z), 1e-6);
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
