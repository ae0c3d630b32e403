// test_rbf.c - the curve of seven weights, and its fit to the theory.
#include "base/lsq.h"
#include "flight/rbf.h"
#include "rig/bells.h"
#include "rig/oracle.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <float.h>

// The exact weights for 1 + ca exp(-cb z) on 21 points.
static void fit_exactly(double ca, double cb, double w[RBF_N]) {
  double rows[21][RBF_N], y[21];
  for (int i = 0; i <= 20; i++) {
    bells_at(0.005 * i, rows[i]);
    y[i] = bells_theory(ca, cb, 0.005 * i);
  }
  lsq_solve(21, RBF_N, &rows[0][0], y, w);
}

TEST(rbf_gives_the_golden_values_and_slopes) {
  static const struct {
    double z, ratio, slope;
  } row[] = {
      {0.00, 1.433467, -17.104}, {0.01, 1.188467, -17.099}, {0.02, 1.094100, -6.742},
      {0.03, 1.038108, -3.998},  {0.05, 1.012265, -0.125},  {0.10, 1.016193, 4.119},
  };
  const rbf_weights_t w = bells_golden_weights();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m", row[i].z);
    const rbf_point_t at = rbf_at(&w, (float)row[i].z);
    CHECK_NEAR(at.ratio, row[i].ratio, 1e-6);
    CHECK_NEAR(at.slope_per_m, row[i].slope, 6e-4);
  }
}

TEST(rbf_slope_is_the_finite_difference_of_the_value) {
  splitmix_t r = {2};
  for (int set = 0; set < 20; set++) {
    rbf_weights_t w;
    for (int i = 0; i < RBF_N; i++) w.w[i] = (float)splitmix_between(&r, -1.0, 1.0);
    for (int mm = -20; mm <= 250; mm++) {
      const float z = 1e-3f * (float)mm;
      ROW("set %d at %d mm", set, mm);
      const rbf_point_t at = rbf_at(&w, z);
      CHECK_NEAR(at.ratio, bells_ratio(&w, (double)z), 2e-6);
      CHECK_NEAR(at.slope_per_m, bells_slope(&w, (double)z), 5e-4);
    }
  }
}

TEST(rbf_is_its_constant_far_away) {
  static const float z[] = {0.5f, 4.0f, -4.0f, 1e10f, -1e10f, FLT_MAX, -FLT_MAX};
  const rbf_weights_t w = bells_golden_weights();
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
    CHECK_NEAR(w[i], bells_golden[i], 6e-9); // to the last digit that is printed
  }
}

TEST(rbf_fit_has_condition_115) {
  double square[RBF_N][RBF_N] = {{0}}, values[RBF_N];
  for (int k = 0; k <= 20; k++) {
    double basis[RBF_N];
    bells_at(0.005 * k, basis);
    for (int i = 0; i < RBF_N; i++)
      for (int j = 0; j < RBF_N; j++) square[i][j] += basis[i] * basis[j];
  }
  oracle_eigenvalues((const double(*)[RBF_N])square, values);
  CHECK_NEAR(sqrt(values[RBF_N - 1] / values[0]), 115.0, 0.5);
}

TEST(rbf_golden_weights_are_the_exact_fit_of_the_theory) {
  double exact[RBF_N];
  fit_exactly(0.44, 80.0, exact);
  for (int k = 0; k < RBF_N; k++) CHECK_NEAR(bells_golden[k], exact[k], 1e-7);
}

TEST(rbf_golden_curve_is_as_far_from_the_theory_as_the_prototype_was) {
  const rbf_weights_t w = bells_golden_weights();
  double max_5mm = 0.0, max_1mm = 0.0, square = 0.0;
  for (int i = 0; i <= 1000; i++) { // 0.1 mm: on a coarser grid the ends weigh too much in the rms
    const double z = 1e-4 * i;
    const double error = (double)rbf_at(&w, (float)z).ratio - bells_theory(0.44, 80.0, z);
    if (i % 10 == 0) max_1mm = fmax(max_1mm, fabs(error));
    if (i % 50 == 0) max_5mm = fmax(max_5mm, fabs(error));
    square += error * error;
  }
  CHECK_NEAR(max_5mm, 1.60e-2, 5e-5);
  CHECK_NEAR(max_1mm, 1.84e-2, 5e-5);
  CHECK_NEAR(sqrt(square / 1001.0), 5.8e-3, 5e-5);
}
