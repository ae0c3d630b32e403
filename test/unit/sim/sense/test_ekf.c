// test_ekf.c - the estimator on known motions: size of its errors, delays, take-off, repeatability.
#include "rig/ekf_rig.h"
#include "rig/test.h"
#include "sense/ekf.h"
#include <string.h>

TEST(ekf_follows_known_motions_with_errors_of_realistic_size) {
  // Largest root mean squares allowed: mm, mm/s, mm/s, degrees. Quiet: what delay and dead zone leave. Climbs
  // of 0.6 m/s lag by 20 ms; a yaw of 0.8 rad/s lags by 9 ms.
  static const struct {
    const char *what, *level;
    const kinematic_t *path;
    double z_mm, climb_mmps, side_mmps, tilt_deg, yaw_deg;
  } row[] = {
      {"hover, quiet", "quiet", &ekf_rig_hover, 0.01, 0.01, 0.01, 0.001, 0.001},
      {"climb, quiet", "quiet", &ekf_rig_climb, 4.0, 9.0, 0.01, 0.001, 0.001},
      {"sideways, quiet", "quiet", &ekf_rig_step, 0.2, 2.0, 20.0, 0.35, 0.01},
      {"turn, quiet", "quiet", &ekf_rig_turn, 0.01, 0.01, 0.01, 0.01, 0.45},
      {"hover", "real", &ekf_rig_hover, 1.5, 10.0, 40.0, 0.25, 0.1},
      {"climb", "real", &ekf_rig_climb, 5.0, 15.0, 50.0, 0.25, 0.1},
      {"sideways", "real", &ekf_rig_step, 1.6, 10.0, 50.0, 0.4, 0.2},
      {"turn", "real", &ekf_rig_turn, 1.6, 10.0, 50.0, 0.25, 0.5},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ekf_rig_t r = ekf_rig(row[i].level, 11);
    const ekf_errors_t e = ekf_rig_follow(&r, row[i].path, 1.0, 6.0);
    CHECK(1e3 * e.z_m < row[i].z_mm);
    CHECK(1e3 * e.climb_mps < row[i].climb_mmps);
    CHECK(1e3 * e.side_mps < row[i].side_mmps);
    CHECK(e.tilt_rad < row[i].tilt_deg * DEG);
    CHECK(e.yaw_rad < row[i].yaw_deg * DEG);
    CHECK(e.xy_end_m < 0.2);
    CHECK(r.ekf.resets == 0);
    random_close(r.random);
  }
}

TEST(ekf_height_near_the_ground_is_good_to_a_millimetre_and_knows_it) {
  ekf_rig_t r = ekf_rig("real", 4);
  const ekf_errors_t e = ekf_rig_follow(&r, &ekf_rig_hover, 2.0, 60.0);
  CHECK_NEAR(e.z_m, 0.00115, 0.0002);
  CHECK_NEAR(e.climb_mps, 0.0080, 0.0015);
  CHECK(fabs(e.z_mean_m) < 0.0002 && fabs(e.climb_mean_mps) < 0.001);
  // What it expects of itself is somewhat larger, because it expects 1 m/s2 of unknown acceleration.
  CHECK(sqrt(r.ekf.P[2][2]) > e.z_m && sqrt(r.ekf.P[2][2]) < 2.0 * e.z_m);
  // No two states go together more than wholly.
  for (int i = 0; i < EKF_N; i++)
    for (int j = i + 1; j < EKF_N; j++) CHECK(r.ekf.P[i][j] * r.ekf.P[i][j] < r.ekf.P[i][i] * r.ekf.P[j][j]);
  random_close(r.random);
}

TEST(ekf_height_lags_by_the_age_of_the_range_and_by_half_a_prediction) {
  // Of a steady climb the mean innovation is 0. At odd samples the newest prediction is 5 ms old, at even
  // ones new, the range 13 ms: the prediction lags 13 - 2.5 ms; it is then held 0 to 9 ms and handed out 1 ms
  // later.
  ekf_rig_t r = ekf_rig("quiet", 1);
  const double climb_mps = 0.2;
  const truth_t start = ekf_rig_level(0.1, (d3_t){0.0, 0.0, climb_mps}, (d3_t){0.0, 0.0, 0.0});
  ekf_rig_place(&r, &start);
  double lag_s = 0.0;
  for (int ms = 0; ms < 6000; ms++) {
    const truth_t truth = ekf_rig_level(0.1 + 1e-3 * climb_mps * ms, start.vel_w_mps, start.rate_b_radps);
    const ekf_out_t out = ekf_rig_tick(&r, &truth);
    if (ms >= 3000) lag_s += (truth.pos_w_m.z - out.pos_w_m.z) / climb_mps / 3000.0;
  }
  CHECK_NEAR(lag_s, 0.0105 + 0.0045 + 0.001, 0.0015);
  random_close(r.random);
}

TEST(ekf_attitude_lags_by_the_gyro_filter_and_half_a_prediction) {
  // Gyro 2.8 ms, the mean over ten samples and its hold 0 to 9 ms, 1 ms to be handed out.
  ekf_rig_t r = ekf_rig("quiet", 1);
  const truth_t start = kinematic_at(&ekf_rig_turn, 0.0);
  ekf_rig_place(&r, &start);
  double behind = 0.0, square = 0.0;
  for (int ms = 0; ms < 5000; ms++) {
    const truth_t truth = kinematic_at(&ekf_rig_turn, 1e-3 * ms);
    const ekf_out_t out = ekf_rig_tick(&r, &truth);
    const double error = 2.0 * (truth.q_wb.z * out.q_wb.w - truth.q_wb.w * out.q_wb.z),
                 rate = truth.rate_b_radps.z;
    behind += error * rate;
    square += rate * rate;
  }
  CHECK_NEAR(behind / square, 0.0028 + 0.0045 + 0.001 + 0.0005, 0.001);
  random_close(r.random);
}

// Everything that came out of four seconds of a flight.
static void flown(uint64_t seed, double ceiling_m, ekf_out_t *out, int n) {
  ekf_rig_t r = ekf_rig("real", seed);
  kinematic_t path = ekf_rig_step;
  path.ceiling_m = ceiling_m;
  const truth_t start = kinematic_at(&path, 0.0);
  ekf_rig_place(&r, &start);
  for (int ms = 0; ms < n; ms++) {
    const truth_t truth = kinematic_at(&path, 1e-3 * ms);
    out[ms] = ekf_rig_tick(&r, &truth);
  }
  random_close(r.random);
}

TEST(ekf_never_reads_the_upward_range_and_the_same_seed_gives_the_same_bits) {
  enum { N = 4000 };
  ekf_out_t first[N], other[N];
  flown(7, 0.45, first, N);
  flown(7, 0.45, other, N);
  CHECK(memcmp(first, other, sizeof first) == 0);
  flown(7, HUGE_VAL, other, N);
  CHECK(memcmp(first, other, sizeof first) == 0);
  flown(8, 0.45, other, N);
  CHECK(memcmp(first, other, sizeof first) != 0);
}

TEST(ekf_takes_off_from_the_ground) {
  ekf_rig_t r = ekf_rig("real", 2);
  kinematic_t path = ekf_rig_climb;
  path.from_m.z = 0.02;
  path.start_s = 3.0;
  path.motors_on_s = 2.5;
  ekf_errors_t e = {0};
  for (int ms = 0; ms < 16000; ms++) {
    const truth_t truth = kinematic_at(&path, 1e-3 * ms);
    const ekf_out_t out = ekf_rig_tick(&r, &truth);
    if (ms == 2400) CHECK_NEAR(out.pos_w_m.z, 0.02, 0.004);
    if (ms >= 6000) ekf_rig_compare(&e, &out, &truth);
  }
  CHECK(sqrt(e.z_m / 10000.0) < 0.002);
  CHECK(sqrt(e.climb_mps / 10000.0) < 0.015);
  CHECK(sqrt(e.tilt_rad / 10000.0) < 0.5 * DEG);
  random_close(r.random);
}

TEST(ekf_uncertainty_of_the_attitude_turns_by_half_the_angle_of_the_body) {
  // As in the firmware, whose error of the attitude is turned by half the vector that the gyro gives.
  ekf_t e;
  ekf_init(&e, &ekf_firmware, 0.0);
  for (int i = 0; i < EKF_N; i++)
    for (int j = 0; j < EKF_N; j++) e.P[i][j] = i == j ? 1e-3 : 0.0;
  e.P[6][6] = 0.02;
  const double rate_radps = 2.0, dt_s = 0.01;
  ekf_core_predict(&e, (d3_t){0.0, 0.0, 9.81}, (d3_t){0.0, 0.0, rate_radps}, dt_s, true);
  const double half_rad = 0.5 * rate_radps * dt_s;
  CHECK_NEAR(e.P[6][7], -half_rad * (0.02 - 1e-3), 0.02 * half_rad * 0.02);
}
