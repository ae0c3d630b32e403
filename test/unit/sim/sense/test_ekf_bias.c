// test_ekf_bias.c - what the estimator makes of wrong sensors, in flight and on the ground.
#include "rig/ekf_rig.h"
#include "rig/test.h"

#define BIAS_Z 0.0122 // s2, s: errors of height and climb for each m/s2 of bias (ekf.h)
#define BIAS_V 0.153

// The vertical axis alone, with the filter's numbers, written anew: two states, noise each ms, prediction
// each 10 ms, range each 25 ms. Mean errors that a constant acceleration error leaves.
static void bias_by_two_states(double bias, double range_sd_m, double *z_m, double *climb_mps) {
  double p11 = 1e-6, p12 = 0.0, p22 = 1e-4, z = 0.0, v = 0.0;
  *z_m = *climb_mps = 0.0;
  for (int ms = 1; ms <= 20000; ms++) {
    if (ms % 10 == 0) {
      z += 0.01 * v + 0.5e-4 * bias;
      v += 0.01 * bias;
      p11 += 0.02 * p12 + 1e-4 * p22;
      p12 += 0.01 * p22;
    }
    p22 += 1e-6;
    if (ms % 25 == 0) {
      const double s = p11 + range_sd_m * range_sd_m, k1 = p11 / s, k2 = p12 / s, error = -z;
      z += k1 * error;
      v += k2 * error;
      p22 -= k2 * p12;
      p12 -= k1 * p12;
      p11 -= k1 * p11;
    }
    if (ms > 10000) *z_m += z / 10000.0, *climb_mps += v / 10000.0;
  }
}

TEST(ekf_answers_an_accelerometer_bias_as_two_states_do) {
  static const struct {
    double bias, height_m;
  } row[] = {{0.1, 0.3}, {-0.1, 0.3}, {0.3, 0.3}, {0.1, 0.05}, {0.1, 1.0}, {0.01, 0.5}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("bias %g at %g m", row[i].bias, row[i].height_m);
    ekf_rig_t r = ekf_rig("quiet", 1);
    CHECK(noise_set(&r.noise, "acc.bias.z", row[i].bias));
    kinematic_t path = ekf_rig_hover;
    path.from_m.z = path.to_m.z = row[i].height_m;
    const ekf_errors_t e = ekf_rig_follow(&r, &path, 10.0, 20.0);
    double z_m, climb_mps;
    const double sd_m = 0.0025 * (1.0 + exp(log(80.0) / 1.5 * (row[i].height_m - 2.5)));
    bias_by_two_states(row[i].bias, sd_m, &z_m, &climb_mps);
    CHECK_NEAR(e.z_mean_m / z_m, 1.0, 0.01); // the floor of the variances is in one of them only
    CHECK_NEAR(e.climb_mean_mps / climb_mps, 1.0, 0.01);
    // The header's numbers.
    CHECK_NEAR(e.z_mean_m, BIAS_Z * row[i].bias, 0.03 * BIAS_Z * fabs(row[i].bias));
    CHECK_NEAR(e.climb_mean_mps, BIAS_V * row[i].bias, 0.03 * BIAS_V * fabs(row[i].bias));
    CHECK(e.side_mps < 1e-6 && e.tilt_rad < 1e-6);
    random_close(r.random);
  }
}

TEST(ekf_in_flight_ignores_the_horizontal_accelerometer_and_on_the_ground_does_not) {
  static const struct {
    const char *what;
    bool motors;
    int after_ms;
    bool ignored;
  } row[] = {{"in flight", true, 1000, true},
             {"motors off for less than 2 s", false, 1900, true},
             {"on the ground", false, 2300, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ekf_rig_t a = ekf_rig("quiet", 1), b = ekf_rig("quiet", 1);
    truth_t truth = ekf_rig_level(0.3, (d3_t){0.0, 0.0, 0.0}, (d3_t){0.0, 0.0, 0.0});
    ekf_rig_place(&a, &truth);
    ekf_rig_place(&b, &truth);
    CHECK(noise_set(&b.noise, "acc.bias.x", 1.0));
    truth.motors = row[i].motors;
    const ekf_out_t x = ekf_rig_stay(&a, &truth, row[i].after_ms),
                    y = ekf_rig_stay(&b, &truth, row[i].after_ms);
    CHECK((x.vel_w_mps.x == y.vel_w_mps.x && x.q_wb.y == y.q_wb.y) == row[i].ignored);
    random_close(a.random);
    random_close(b.random);
  }
}

TEST(ekf_on_the_ground_goes_back_to_level_and_in_flight_does_not) {
  // A yaw error is seen by nothing else: 0.1 % of it each 10 ms, a tenth each second.
  static const struct {
    bool motors;
    double want;
  } row[] = {{false, 0.904837}, {true, 1.0}};
  for (int i = 0; i < 2; i++) {
    ekf_rig_t r = ekf_rig("quiet", 1);
    truth_t truth = ekf_rig_level(0.01, (d3_t){0.0, 0.0, 0.0}, (d3_t){0.0, 0.0, 0.0});
    r.ekf.q = (dq_t){cos(0.1), 0.0, 0.0, sin(0.1)};
    truth.motors = row[i].motors;
    const ekf_out_t out = ekf_rig_stay(&r, &truth, 1000);
    CHECK_NEAR(2.0 * asin(out.q_wb.z) / 0.2, row[i].want, 2e-3);
    random_close(r.random);
  }
}

TEST(ekf_in_flight_finds_level_again_through_the_flow_but_for_the_dead_zone) {
  // Corrections of less than 1e-4 rad each are dropped: without noise the last quarter of a degree stays, and
  // with it 2 cm/s of velocity. Noise carries the corrections over the edge.
  ekf_rig_t r = ekf_rig("quiet", 1);
  truth_t truth = ekf_rig_level(0.4, (d3_t){0.0, 0.0, 0.0}, (d3_t){0.0, 0.0, 0.0});
  ekf_rig_place(&r, &truth);
  r.ekf.q = dq_unit((dq_t){1.0, sin(1.0 * DEG), 0.0, 0.0}); // believes in 2 deg of roll
  ekf_rig_stay(&r, &truth, 3000);
  ekf_out_t out = ekf_rig_stay(&r, &truth, 3000);
  CHECK_NEAR(2.0 * out.q_wb.x, 0.24 * DEG, 0.02 * DEG);
  CHECK_NEAR(out.vel_w_mps.y, -0.0187, 0.001);
  r.noise = *noise_find("real");
  double mean = 0.0;
  for (int ms = 0; ms < 20000; ms++) {
    out = ekf_rig_tick(&r, &truth);
    if (ms >= 2000) mean += 2.0 * out.q_wb.x / 18000.0;
  }
  CHECK_NEAR(mean, 0.0, 0.08 * DEG);
  random_close(r.random);
}
