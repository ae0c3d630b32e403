// test_stock_pid.c - the stock PID as a peer: single blocks by hand, and closed loop on the test rig.
#include "crazyflie/stock_pid.h"
#include "rig/rig6.h"
#include "rig/test.h"

#define TURN 6.283185307179586

TEST(pid_block_is_the_sum_of_its_terms_with_its_limits) {
  // 500 Hz, one sample of 0.1 from rest and 0.2 wanted: P 6 x 0.1, I 3 x 0.1/500, D -0.5 x 0.1 x 500.
  static const struct {
    const char *what;
    pid_gain_t gain;
    double wanted, measured, output;
  } row[] = {
      {"P", {6, 0, 0, 20, 0, 0}, 0.2, 0.1, 0.6},
      {"I", {0, 3, 0, 20, 0, 0}, 0.2, 0.1, 6e-4},
      {"I at its limit", {0, 3, 0, 1e-4, 0, 0}, 0.2, 0.1, 3e-4},
      {"D of the measurement", {0, 0, 0.5, 20, 0, 0}, 0.2, 0.1, -25.0},
      {"no kick by the set point", {0, 0, 0.5, 20, 0, 0}, 90.0, 0.0, 0.0},
      {"output at its limit", {6, 0, 0, 20, 0.25, 0}, 0.2, 0.1, 0.25},
      // Butterworth 20 Hz at 500 Hz: b = 0.0133592
      {"D filtered", {0, 0, 0.5, 20, 0, 20}, 0.2, 0.1, -25.0 * 0.0133592},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    pid_block_t s;
    pid_block_start(&s, &row[i].gain, 500.0, 0.0);
    CHECK_NEAR(pid_block_step(&s, &row[i].gain, 500.0, row[i].wanted, row[i].measured, false), row[i].output,
               1e-6);
  }
}

TEST(pid_block_takes_angles_the_short_way) {
  const pid_gain_t gain = {6, 0, 0.5, 360, 0, 0};
  pid_block_t s;
  pid_block_start(&s, &gain, 500.0, 179.0);
  CHECK_NEAR(pid_block_step(&s, &gain, 500.0, -179.0, -179.5, true), 6 * 0.5 - 0.5 * 1.5 * 500.0, 1e-9);
}

TEST(stock_mixer_and_power_have_known_numbers) {
  double unit[4], motor_N[4];
  stock_mix(&(stock_command_t){.thrust = 40000.9, .roll = 1001, .pitch = -301, .yaw = 77}, unit);
  const double want[4] = {40000 - 500 - 150 + 77, 40000 - 500 + 150 - 77, 40000 + 500 + 150 + 77,
                          40000 + 500 - 150 - 77};
  for (int i = 0; i < 4; i++)
    CHECK_NEAR(unit[i], want[i], 1.0); // the fraction of the thrust is cut after the sum
  static const struct {
    const char *what;
    double unit[4], vbat_V, motor_N[4];
  } row[] = {
      {"hover of 32.9 g", {44065, 44065, 44065, 44065}, 4.2, {0.08069, 0.08069, 0.08069, 0.08069}},
      {"below 7000 units a motor is off", {6999, 7001, 0, -5000}, 4.2, {0, 0.01282, 0, 0}},
      {"65535 is not yet the limit at 4.2 V",
       {70000, 50000, 50000, 50000},
       4.2,
       {0.12818, 0.09155, 0.09155, 0.09155}},
      {"under 2 V all stop", {44065, 44065, 44065, 44065}, 1.9, {0, 0, 0, 0}},
      {"voltage unknown", {44065, 44065, 44065, 44065}, (double)NAN, {0, 0, 0, 0}},
  };
  const stock_power_param_t legacy = stock_power_legacy();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    stock_power_t s;
    stock_power_start(&s);
    for (int k = 0; k < 2000; k++) stock_power_step(&s, &legacy, row[i].unit, row[i].vbat_V, motor_N);
    // 16-bit duty: 1e-5 of full scale
    for (int m = 0; m < 4; m++) CHECK_NEAR(motor_N[m], row[i].motor_N[m], 1e-5);
  }
}

TEST(stock_power_gives_up_thrust_for_attitude_when_the_battery_is_empty) {
  // At 2.8 V the motors give N(2.8 V) = 0.1035 N; all duties go down by what the highest is above full.
  const double unit[4] = {60000, 64000, 40000, 50000};
  const stock_power_param_t p = stock_power_legacy();
  stock_power_t s;
  double motor_N[4], full_N[4];
  stock_power_start(&s);
  for (int k = 0; k < 2000; k++) stock_power_step(&s, &p, unit, 2.8, motor_N);
  CHECK_NEAR(motor_N[1], 0.10348, 1e-5);
  stock_power_start(&s);
  for (int k = 0; k < 2000; k++) stock_power_step(&s, &p, unit, 4.0, full_N);
  for (int i = 0; i < 4; i++) CHECK(motor_N[i] < full_N[i]);
  CHECK(motor_N[0] < motor_N[1] && motor_N[3] < motor_N[0] && motor_N[2] < motor_N[3]);
}

TEST(stock_view_has_the_signs_of_the_firmware) {
  const double h = 0.05; // half an angle of 0.1 rad
  static const char *const what[3] = {"right side down", "nose up", "turned left"};
  const dq_t q[3] = {{cos(h), sin(h), 0, 0}, {cos(h), 0, -sin(h), 0}, {cos(h), 0, 0, sin(h)}};
  for (int i = 0; i < 3; i++) {
    ROW("%s", what[i]);
    const stock_view_t v = stock_view(&(pilot_in_t){.q_wb = q[i], .acc_b_mps2 = {0, 0, 9.81}});
    CHECK_NEAR(v.roll_deg, i == 0 ? 5.729578 : 0.0, 1e-6);
    CHECK_NEAR(v.pitch_deg, i == 1 ? 5.729578 : 0.0, 1e-6);
    CHECK_NEAR(v.yaw_deg, i == 2 ? 5.729578 : 0.0, 1e-6);
    CHECK_NEAR(v.acc_g.z, 1.0, 1e-12);
  }
}

TEST(stock_pid_first_commands_are_those_by_hand) {
  // 0.1 m below and 0.1 m behind the set point, at rest, first tick: position PID 2 x 0.1 (+ 0.5 x 0.1/100 in
  // z), velocity PID: pitch -(25.01 x 0.2) nose down, thrust 1000 (25.15 x 0.2005) + 36000.
  stock_pid_t s;
  const stock_pid_param_t param = stock_pid_default();
  stock_pid_pilot(&s, &param);
  const pilot_setpoint_t set = rig6_hold((d3_t){0.1, 0, 1.1}, 0.0);
  const stock_command_t *c = stock_pid_command(
      &s, &(pilot_in_t){.pos_w_m = {0, 0, 1.0}, .q_wb = {.w = 1}, .vbat_V = 4.2, .set = set});
  CHECK_NEAR(s.wanted.pitch_deg, -(25.0 + 0.01) * 0.2, 1e-9);
  CHECK_NEAR(s.wanted.roll_deg, 0.0, 1e-12);
  CHECK_NEAR(c->thrust, 36000.0 + 1000.0 * (25.0 + 0.15) * 0.2005, 1e-6);
  const double wanted_dps = -5.002 * (6.0 + 3.0 / 500.0);
  CHECK_NEAR(c->pitch, trunc(wanted_dps * (250.0 + 500.0 / 500.0)), 1.0);
}

TEST(stock_pid_hovers_and_takes_steps) {
  rig6_param_t body = rig6_crazyflie();
  static const struct {
    const char *what;
    d3_t to;
    double yaw_rad;
  } row[] = {
      {"hover", {0, 0, 1}, 0.0},
      {"up half a metre", {0, 0, 1.5}, 0.0},
      {"sideways", {0.5, -0.5, 1}, 0.0},
      {"sideways and turned", {0.5, 0, 1}, TURN / 4},
      {"turned over the seam", {0, 0, 1}, 0.55 * TURN},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    stock_pid_t s;
    const stock_pid_param_t param = stock_pid_default();
    const pilot_t pilot = stock_pid_pilot(&s, &param);
    rig6_t r = rig6_at(&body, (d3_t){0, 0, 1}, 0.45 * TURN, true);
    const pilot_setpoint_t set = rig6_hold(row[i].to, row[i].yaw_rad);
    rig6_fly(&r, &pilot, &set, 20.0, NULL, NULL);
    // The integral terms pull the last millimetres in slowly.
    CHECK_NEAR(r.pos_w_m.x, row[i].to.x, 0.005);
    CHECK_NEAR(r.pos_w_m.y, row[i].to.y, 0.005);
    CHECK_NEAR(r.pos_w_m.z, row[i].to.z, 0.005);
    CHECK_NEAR(remainder(rig6_yaw_rad(&r) - row[i].yaw_rad, TURN), 0.0, 0.01);
    CHECK_NEAR(rig6_tilt_rad(&r), 0.0, 0.002);
  }
}

TEST(stock_pid_keeps_its_limits_on_a_large_step) {
  stock_pid_t s;
  const stock_pid_param_t param = stock_pid_default();
  const pilot_t pilot = stock_pid_pilot(&s, &param);
  const rig6_param_t body = rig6_crazyflie();
  rig6_t r = rig6_at(&body, (d3_t){0, 0, 1}, 0.0, true);
  const pilot_setpoint_t set = rig6_hold((d3_t){5, 0, 4}, 0.0);
  double fastest_mps = 0.0, steepest_rad = 0.0;
  for (int i = 0; i < 300; i++) {
    rig6_fly(&r, &pilot, &set, 0.01, NULL, NULL);
    fastest_mps = fmax(fastest_mps, r.vel_w_mps.x);
    steepest_rad = fmax(steepest_rad, rig6_tilt_rad(&r));
    CHECK(fabs(s.wanted.pitch_deg) <= 20.0 && s.wanted.thrust >= 20000.0 && s.wanted.thrust <= 65535.0);
  }
  CHECK(fastest_mps > 0.9 && fastest_mps < 1.4);                             // 1.1 m/s and its overshoot
  CHECK(steepest_rad > 15.0 / STOCK_DEG && steepest_rad < 30.0 / STOCK_DEG); // 20 degrees and theirs
}

TEST(stock_pid_honours_body_velocity_and_yaw_rate) {
  stock_pid_t s;
  const stock_pid_param_t param = stock_pid_default();
  const pilot_t pilot = stock_pid_pilot(&s, &param);
  const rig6_param_t body = rig6_crazyflie();
  rig6_t r = rig6_at(&body, (d3_t){0, 0, 1}, TURN / 4, true);
  pilot_setpoint_t set = rig6_go((d3_t){0.5, 0, 0}, 1.0, TURN / 4);
  set.vel_in_body = true;
  rig6_fly(&r, &pilot, &set, 4.0, NULL, NULL);
  CHECK_NEAR(r.vel_w_mps.y, 0.5, 0.03);
  CHECK_NEAR(r.vel_w_mps.x, 0.0, 0.03);
  set.yaw_by_rate = true;
  set.yaw_rate_radps = 1.0;
  rig6_fly(&r, &pilot, &set, 4.0, NULL, NULL);
  CHECK_NEAR(r.rate_b_radps.z, 1.0, 0.03);
}

TEST(stock_pid_without_thrust_stops_and_forgets) {
  stock_pid_t s;
  const stock_pid_param_t param = stock_pid_default();
  const pilot_t pilot = stock_pid_pilot(&s, &param);
  rig6_param_t body = rig6_crazyflie();
  body.floor = true;
  rig6_t r = rig6_at(&body, (d3_t){0, 0, 0}, 1.0, false);
  const pilot_setpoint_t off = {.thrust_N = 0.0}, up = rig6_hold((d3_t){0, 0, 0.5}, 1.0);
  rig6_fly(&r, &pilot, &off, 30.0, NULL, NULL);
  for (int i = 0; i < 4; i++) CHECK(r.command_N[i] == 0.0);
  CHECK_NEAR(s.yaw_deg, STOCK_DEG, 1e-6);
  rig6_fly(&r, &pilot, &up, 15.0, NULL, NULL);
  CHECK_NEAR(r.pos_w_m.z, 0.5, 0.01);
}
