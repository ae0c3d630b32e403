// test_mocap.c - motion capture, and what the estimator makes of it.
#include "crazyflie/stock_units.h"
#include "rig/test.h"
#include "sense/ekf.h"
#include "sense/mocap.h"

TEST(mocap_poses_come_late_at_their_rate_and_turned) {
  random_t *r = random_open(1);
  if (!CHECK(r != NULL)) return;
  const mocap_param_t p = {.period_s = 0.018, .late_s = 0.010, .tilt_rad = {0.1, 0.0}};
  mocap_t s = {0};
  truth_t truth = {.q_wb = {1.0, 0.0, 0.0, 0.0}};
  int count = 0;
  for (int ms = 0; ms < 180; ms++) {
    truth.pos_w_m.z = 1e-3 * ms;
    const mocap_sample_t sample = mocap_step(&s, &p, r, &truth);
    if (!sample.is_new) continue;
    count++;
    CHECK_NEAR(sample.pos_w_m.z, 1e-3 * (ms - 10), 1e-12);
    CHECK_NEAR(2.0 * sample.q_wb.x, 0.1, 2e-4); // small angle
  }
  CHECK(count == 10);
  random_close(r);
}

TEST(ekf_follows_the_pose_of_motion_capture) {
  ekf_t e;
  ekf_init(&e, &ekf_firmware, 0.0);
  const dq_t lean = dq_unit((dq_t){1.0, 0.02, -0.01, 0.0});
  ekf_out_t out = {.q_wb = {1.0, 0.0, 0.0, 0.0}};
  for (int ms = 0; ms < 3000; ms++) {
    const ekf_in_t in = {.imu.acc_b_mps2 = dq_to_body(lean, (d3_t){0.0, 0.0, 9.81}),
                         .pose_new = ms % 18 == 0,
                         .pose_m = {0.3, -0.2, 0.1},
                         .pose_q = lean};
    out = ekf_step(&e, &in);
  }
  CHECK_NEAR(out.pos_w_m.x, 0.3, 4e-3);
  CHECK_NEAR(out.pos_w_m.y, -0.2, 4e-3);
  CHECK_NEAR(out.pos_w_m.z, 0.1, 4e-3);
  CHECK_NEAR(out.q_wb.x, lean.x, 4e-3); // at rest the filter pulls towards level
  CHECK_NEAR(out.q_wb.y, lean.y, 4e-3);
  CHECK_NEAR(d3_norm(out.vel_w_mps), 0.0, 0.02);
}

TEST(stock_power_of_2022_gives_a_fifth_less_than_it_says) {
  const stock_power_param_t p = stock_power_2022();
  const double unit[4] = {36000, 36000, 36000, 36000};
  double motor_N[4];
  stock_power_t s;
  stock_power_start(&s);
  stock_power_step(&s, &p, unit, 4.2, motor_N);
  // 33.0 g are 2.221 V by its quadratic, and 26.2 g by the cubic.
  for (int i = 0; i < 4; i++) CHECK_NEAR(motor_N[i] / 9.81e-3, 26.2 / 4, 0.05);
}
