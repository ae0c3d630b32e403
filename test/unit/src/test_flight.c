// test_flight.c - the whole controller in six degrees of freedom: set points of every kind, and none of the
// eight faults of the firmware's own INDI (spec "the peer").
#include "rig/hover6.h"
#include "rig/test.h"

#include <string.h>

TEST(flight_reaches_positions_and_stays) {
  static const d3_t to[] = {{0.5, 0.0, 0.5}, {0.0, -0.5, 0.7}, {-0.3, 0.3, 0.3}};
  for (unsigned i = 0; i < sizeof to / sizeof *to; i++) {
    ROW("to %g %g %g", to[i].x, to[i].y, to[i].z);
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, 0.7);
    r.in.set.pos_w_m = to[i];
    hover6_fly(&r, 12.0);
    const d3_t error = d3_sub(hover6_pos_m(&r), to[i]);
    CHECK_NEAR(d3_norm(error), 0.0, 0.01);
    CHECK_NEAR(hover6_yaw_rad(&r), 0.7, 0.01);
    body_close(&r.body);
  }
}

TEST(flight_keeps_its_heading_while_it_turns_by_rate) {
  // Fault 1 of the peer: the target is converted from degrees every tick, and the nose driven to 0.
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 1.0);
  r.in.set.yaw_by_rate = true;
  hover6_fly(&r, 3.0);
  CHECK_NEAR(hover6_yaw_rad(&r), 1.0, 0.02);
  r.in.set.yaw_rate_radps = 0.5;
  hover6_fly(&r, 2.0);
  CHECK_NEAR(hover6_yaw_rad(&r), 2.0, 0.15);
  r.in.set.yaw_rate_radps = 0.0;
  hover6_fly(&r, 3.0);
  CHECK_NEAR(hover6_yaw_rad(&r), 2.0, 0.05);
  body_close(&r.body);
}

TEST(flight_turns_the_shorter_way_round) {
  // Fault 2: the error is not wrapped.
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 3.05);
  r.in.set.yaw_rad = -3.05; // 10.5 degrees to the left across the seam
  double away = 0.0;
  for (int k = 0; k < 100; k++) {
    hover6_fly(&r, 0.02);
    away = fmax(away, fabs(fabs(hover6_yaw_rad(&r)) - 3.14159265));
  }
  CHECK(away < 0.2);
  CHECK_NEAR(hover6_yaw_rad(&r), -3.05, 0.02);
  r.in.set.yaw_rad = -3.05 + 40.0 * 3.14159265358979; // any number of turns
  hover6_fly(&r, 2.0);
  CHECK_NEAR(hover6_yaw_rad(&r), -3.05, 0.02);
  body_close(&r.body);
}

TEST(flight_takes_a_velocity_of_the_body_along_its_heading) {
  // Fault 3: taken for one of the world.
  static const struct {
    const char *what;
    double yaw_rad, ahead_mps, left_mps;
  } row[] = {{"ahead, nose to the left", 1.5707963, 0.3, 0.0},
             {"to the left, oblique", 0.7, 0.0, 0.3},
             {"both, nose back", -2.5, 0.2, -0.25}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, row[i].yaw_rad);
    r.in.set.mode[0] = r.in.set.mode[1] = PILOT_VELOCITY;
    r.in.set.vel_in_body = true;
    r.in.set.vel_mps = (d3_t){row[i].ahead_mps, row[i].left_mps, 0.0};
    hover6_fly(&r, 4.0);
    const double c = cos(row[i].yaw_rad), s = sin(row[i].yaw_rad);
    CHECK_NEAR(r.body.y[RIGID_VEL_MPS], c * row[i].ahead_mps - s * row[i].left_mps, 0.02);
    CHECK_NEAR(r.body.y[RIGID_VEL_MPS + 1], s * row[i].ahead_mps + c * row[i].left_mps, 0.02);
    body_close(&r.body);
  }
}

TEST(flight_by_hand_takes_tilts_for_radians) {
  // Fault 4: with the outer loop off, degrees were used as radians. Here all is SI; a tilt is what it says.
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 0.0);
  flight_in_t in = {.q_wb = {.w = 1.0f}, .acc_b_mps2 = {.z = GRAVITY_MPS2}};
  for (int i = 0; i < MOTORS; i++) in.force_N[i] = 0.08f;
  in.setpoint = (flight_setpoint_t){.roll_rad = 0.1f, .pitch_rad = -0.2f, .thrust_N = 0.32f};
  const flight_out_t out = *flight_step(r.flight.flight, &in);
  const v3_t up = quat_up(out.q_ref);
  CHECK_NEAR(up.x, sin(-0.2) * cos(0.1), 1e-5);
  CHECK_NEAR(up.y, -sin(0.1), 1e-5);
  CHECK_NEAR(out.motors.thrust_N, 0.32, 1e-6);
  body_close(&r.body);
}

TEST(flight_learns_nothing_wrong_on_the_ground) {
  // Fault 5: 30 s on the ground with -0.01 g wound the thrust up to full. Here the first command is a small
  // step.
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 0.0);
  r.in.set.mode[0] = r.in.set.mode[1] = r.in.set.mode[2] = PILOT_OFF;
  double motor_N[PILOT_MOTORS], sum = 0.0;
  for (int i = 0; i < PILOT_MOTORS; i++) r.in.applied_N[i] = 0.0;
  hover6_sense(&r);
  r.in.acc_b_mps2 = (d3_t){0.0, 0.0, 9.81 - 0.0981};
  hover6_think(&r, 30000, motor_N);
  CHECK(motor_N[0] == 0.0 && motor_N[1] == 0.0 && motor_N[2] == 0.0 && motor_N[3] == 0.0);
  for (int i = 0; i < 3; i++) r.in.set.mode[i] = PILOT_POSITION;
  hover6_think(&r, 11, motor_N);
  for (int i = 0; i < PILOT_MOTORS; i++) sum += motor_N[i];
  CHECK(sum <= (double)r.flight.param.step_max_N + 1e-6);
  body_close(&r.body);
}

TEST(flight_finds_the_bias_of_its_accelerometer) {
  // Fault 6: 0.01 g was a standing error of b/(kp kd), with the thesis's gains 2 cm, for ever.
  for (int on = 0; on < 2; on++) {
    ROW("bias %s", on ? "found" : "not looked for");
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, 0.0);
    r.flight.param.bias.pole_radps = on ? 1.0f : 0.0f;
    r.flight.param.bias.vel_s = 0.0f; // the velocity is exact here
    r.acc_bias_b_mps2 = (d3_t){0.0, 0.0, 0.0981};
    hover6_fly(&r, 20.0);
    CHECK_NEAR(hover6_pos_m(&r).z - 0.5, on ? 0.0 : -0.0981 / (2.0 * 8.0), on ? 1e-3 : 2e-4);
    body_close(&r.body);
  }
}

TEST(flight_uses_velocity_and_acceleration_of_a_trajectory) {
  // Fault 7: they were dropped. A circle of 0.2 m at 1.5 rad/s is followed closely with them, badly without.
  double error_m[2] = {0.0, 0.0};
  for (int with = 0; with < 2; with++) {
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, 0.0);
    for (int k = 0; k < 4000; k++) {
      const double ramp = fmin(1.0, 0.002 * k / 3.0), w = 1.5, a = w * 0.002 * k, s = sin(a), c = cos(a);
      r.in.set.pos_w_m = (d3_t){0.2 * ramp * c, 0.2 * ramp * s, 0.5};
      r.in.set.vel_mps = with ? (d3_t){-0.2 * w * s * ramp, 0.2 * w * c * ramp, 0.0} : (d3_t){0, 0, 0};
      r.in.set.acc_w_mps2 =
          with ? (d3_t){-0.2 * w * w * c * ramp, -0.2 * w * w * s * ramp, 0.0} : (d3_t){0, 0, 0};
      hover6_fly(&r, 0.002);
      if (k > 2500) error_m[with] = fmax(error_m[with], d3_norm(d3_sub(hover6_pos_m(&r), r.in.set.pos_w_m)));
    }
    body_close(&r.body);
  }
  CHECK(error_m[1] < 0.5 * error_m[0]);
}

TEST(flight_takes_a_changed_cut_off_over_at_once) {
  // Fault 8: cut-offs acted only after the controller had been selected again.
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 0.0);
  hover6_fly(&r, 0.5);
  const lpf2_coef_t inner = r.flight.flight->att_filter, outer = r.flight.flight->outer.coef.filter;
  crazyflie_home(&r.flight.vehicle);
  r.flight.param.cutoff_Hz = 15.0f;
  r.flight.param.att_cutoff_Hz = 30.0f;
  hover6_fly(&r, 0.02);
  CHECK(memcmp(&inner, &r.flight.flight->att_filter, sizeof inner) != 0);
  CHECK(memcmp(&outer, &r.flight.flight->outer.coef.filter, sizeof outer) != 0);
  hover6_fly(&r, 2.0);
  CHECK_NEAR(hover6_pos_m(&r).z, 0.5, 0.01); // without a bump
  body_close(&r.body);
}
