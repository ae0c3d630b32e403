// test_flight_values.c - what the whole controller hands on, against a calculation by hand.
#include "rig/hover6.h"
#include "rig/test.h"

#define HOVER_N 0.32

TEST(flight_follows_a_velocity_on_any_axis) {
  for (int axis = 0; axis < 3; axis++) {
    ROW("axis %d", axis);
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, 0.0);
    r.in.set.mode[axis] = PILOT_VELOCITY;
    r.in.set.pos_w_m = (d3_t){axis == 0 ? -1.0 : 0.0, axis == 1 ? -1.0 : 0.0, axis == 2 ? 0.2 : 0.5};
    double *const wanted[] = {&r.in.set.vel_mps.x, &r.in.set.vel_mps.y, &r.in.set.vel_mps.z};
    *wanted[axis] = 0.2;
    hover6_fly(&r, 4.0);
    for (int i = 0; i < 3; i++) CHECK_NEAR(r.body.y[RIGID_VEL_MPS + i], i == axis ? 0.2 : 0.0, 0.01);
    body_close(&r.body);
  }
}

// Level, by hand; its ceiling is as the outer loop would have left it.
static flight_t under_a_ceiling(flight_param_t *p, flight_in_t *in, rbf_point_t at) {
  *in = (flight_in_t){.step = 2, .q_wb = {.w = 1.0f}, .acc_b_mps2 = {.z = GRAVITY_MPS2}};
  for (int i = 0; i < MOTORS; i++) in->force_N[i] = (float)(0.25 * HOVER_N);
  in->setpoint = (flight_setpoint_t){.thrust_N = (float)HOVER_N};
  flight_t f;
  CHECK_OK(flight_init(&f, p));
  f.out.outer.at = at;
  return f;
}

// Of the inner loop alone: in millisecond 2 of ten the outer one does not run.
static v3_t torque_Nm(flight_t *f, const flight_in_t *in) {
  return flight_step(f, in)->motors.torque_b_Nm;
}

TEST(flight_takes_the_ceilings_torque_of_four_arms_out_and_divides_by_its_ratio) {
  // [2 J kd (0 - rate) + share T rho' arm^2 (motors' lag + filter's) rate] / ratio
  static const struct {
    const char *what;
    float share, cutoff_Hz, ratio, slope_per_m;
    double lag_s;
  } row[] = {{"free air", 1.0f, 0.0f, 1.0f, 0.0f, 0.08},
             {"near", 1.0f, 0.0f, 1.25f, -8.0f, 0.08},
             {"filtered", 1.0f, 20.0f, 1.25f, -8.0f, 0.08 + 0.2251 / 20.0},
             {"half of it", 0.5f, 0.0f, 1.25f, -8.0f, 0.08},
             {"none of it", 0.0f, 0.0f, 1.25f, -8.0f, 0.08}};
  const double rate = 0.2, arm_m = 0.0325, damping_Nms = 2.0 * 16.57e-6 * 12.0;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flight_param_t p;
    flight_in_t in;
    params_default(&p);
    p.tilt_share = row[i].share;
    p.att_cutoff_Hz = row[i].cutoff_Hz;
    const rbf_point_t at = {.ratio = row[i].ratio, .slope_per_m = row[i].slope_per_m};
    flight_t f = under_a_ceiling(&p, &in, at);
    in.rate_b_radps.x = (float)rate;
    const double ceiling_Nms =
        (double)(row[i].share * row[i].slope_per_m) * HOVER_N * arm_m * arm_m * row[i].lag_s;
    const double ratio = row[i].share > 0.0f ? (double)row[i].ratio : 1.0;
    CHECK_NEAR(torque_Nm(&f, &in).x, (ceiling_Nms - damping_Nms) * rate / ratio, 1e-8);
  }
}

TEST(flight_feeds_the_yaw_rate_forward_in_both_modes) {
  // 2 J kd (kp error + rate) / (1 + g2 / 2 ms); by the rate, the heading has turned by 2 ms of it.
  static const struct {
    const char *what;
    yaw_mode_t mode;
    double error_rad;
  } row[] = {{"by the rate", YAW_RATE, 0.002 * 0.1}, {"by the angle", YAW_ANGLE, 0.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flight_param_t p;
    flight_in_t in;
    params_default(&p);
    flight_t f = under_a_ceiling(&p, &in, (rbf_point_t){.ratio = 1.0f});
    in.setpoint.yaw = row[i].mode;
    in.setpoint.yaw_rate_radps = 0.1f;
    const double want_Nm = 2.0 * 29.26e-6 * 12.0 * (5.0 * row[i].error_rad + 0.1) / (1.0 + 0.029 / 0.002);
    CHECK_NEAR(torque_Nm(&f, &in).z, want_Nm, 1e-8);
  }
}

TEST(flight_that_sees_nothing_any_more_gives_all_motors_a_quarter_of_nine_tenths_of_hover) {
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 0.0);
  hover6_fly(&r, 1.0);
  double motor_N[PILOT_MOTORS];
  hover6_sense(&r);
  r.in.gyro_b_radps.x = (double)NAN;
  hover6_think(&r, 100, motor_N);
  for (int i = 0; i < PILOT_MOTORS; i++) {
    ROW("motor %d", i);
    CHECK_NEAR(motor_N[i], 0.25 * 0.9 * 9.81 * r.model.mass_kg, 1e-3);
  }
  body_close(&r.body);
}
