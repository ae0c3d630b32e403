// test_app_units.c - the border of the app: units, signs, frames, and what counts as a new range sample.
#include "crazyflie/stand_in.h"
#include "firmware/glue.h"
#include "firmware/range_up.h"
#include "firmware/units.h"
#include "rig/test.h"

#include <string.h>

static stand_in_t around = {.thrust_max_N = 0.12f};

TEST(app_takes_g_degrees_and_x_y_z_w_from_the_firmware) {
  stand_in = &around;
  const sensorData_t sensors = {.acc = {0.1f, -0.2f, 1.0f}, .gyro = {90.0f, -45.0f, 10.0f}};
  const state_t state = {.attitudeQuaternion = {.x = 0.1f, .y = 0.2f, .z = 0.3f, .w = 0.9f},
                         .attitude = {0, 70.0f, 80.0f, 90.0f}, // not to be looked at: pitch is inverted
                         .position = {0, 1.0f, 2.0f, 3.0f},
                         .velocity = {0, 4.0f, 5.0f, 6.0f}};
  flight_in_t in = {.step = 7};
  units_sensors(&in, &sensors, &state);
  CHECK_NEAR(in.acc_b_mps2.x, 0.981, 1e-6);
  CHECK_NEAR(in.acc_b_mps2.y, -1.962, 1e-6);
  CHECK_NEAR(in.acc_b_mps2.z, 9.81, 1e-6);
  CHECK_NEAR(in.rate_b_radps.x, 1.5707963, 1e-6);
  CHECK_NEAR(in.rate_b_radps.y, -0.78539816, 1e-6);
  CHECK_NEAR(in.rate_b_radps.z, 0.17453293, 1e-6);
  CHECK(in.q_wb.w == 0.9f && in.q_wb.x == 0.1f && in.q_wb.y == 0.2f && in.q_wb.z == 0.3f);
  CHECK(in.pos_w_m.x == 1.0f && in.pos_w_m.y == 2.0f && in.pos_w_m.z == 3.0f);
  CHECK(in.vel_w_mps.x == 4.0f && in.vel_w_mps.y == 5.0f && in.vel_w_mps.z == 6.0f);
}

TEST(app_reads_every_kind_of_set_point_that_the_firmware_makes) {
  stand_in = &around;
  // By hand: roll right-handed, pitch nose up positive and so inverted, thrust of 65535 for all motors.
  const setpoint_t hand = {.mode = {.roll = modeAbs, .pitch = modeAbs, .yaw = modeVelocity},
                           .attitude = {0, 10.0f, 20.0f, 0.0f},
                           .attitudeRate.yaw = -90.0f,
                           .thrust = 32767.5f};
  flight_setpoint_t sp;
  units_setpoint(&sp, &hand);
  CHECK(sp.x == AXIS_OFF && sp.y == AXIS_OFF && sp.z == AXIS_OFF && sp.yaw == YAW_RATE);
  CHECK_NEAR(sp.roll_rad, 0.17453293, 1e-6);
  CHECK_NEAR(sp.pitch_rad, -0.34906585, 1e-6);
  CHECK_NEAR(sp.yaw_rate_radps, -1.5707963, 1e-6);
  CHECK_NEAR(sp.thrust_N, 0.24, 1e-6);
  // Hover: velocity of the body, absolute height.
  const setpoint_t hover = {.mode = {.x = modeVelocity, .y = modeVelocity, .z = modeAbs, .yaw = modeVelocity},
                            .velocity = {0, 0.3f, -0.2f, 0.0f},
                            .velocity_body = true,
                            .position = {0, 0.0f, 0.0f, 0.4f}};
  units_setpoint(&sp, &hover);
  CHECK(sp.x == AXIS_VELOCITY && sp.y == AXIS_VELOCITY && sp.z == AXIS_POSITION && sp.vel_in_body);
  CHECK(sp.vel_mps.x == 0.3f && sp.vel_mps.y == -0.2f && sp.pos_w_m.z == 0.4f);
  // High-level commander: position with velocity and acceleration, yaw in degrees.
  const setpoint_t path = {.mode = {.x = modeAbs, .y = modeAbs, .z = modeAbs, .yaw = modeAbs},
                           .velocity = {0, 0.1f, 0.2f, 0.3f},
                           .acceleration = {0, 0.4f, 0.5f, 0.6f},
                           .attitude.yaw = 180.0f};
  units_setpoint(&sp, &path);
  CHECK(sp.yaw == YAW_ANGLE && sp.vel_mps.y == 0.2f && sp.acc_w_mps2.z == 0.6f && !sp.vel_in_body);
  CHECK_NEAR(sp.yaw_rad, 3.14159265, 1e-5);
  // Full state: the heading stands in a quaternion.
  const setpoint_t full = {.mode = {.x = modeAbs, .y = modeAbs, .z = modeAbs, .quat = modeAbs},
                           .attitudeQuaternion = {.z = 0.3826834f, .w = 0.9238795f}};
  units_setpoint(&sp, &full);
  CHECK(sp.yaw == YAW_ANGLE);
  CHECK_NEAR(sp.yaw_rad, 0.78539816, 2e-5);
  const setpoint_t none = {.attitudeRate.yaw = 50.0f}; // unarmed: zeros, whatever is left over
  units_setpoint(&sp, &none);
  CHECK(sp.z == AXIS_OFF && sp.thrust_N == 0.0f && sp.yaw_rate_radps == 0.0f);
}

TEST(app_names_the_set_points_that_it_does_not_fly) {
  stand_in = &around;
  static const setpoint_mode_t by_hand = {.roll = modeAbs, .pitch = modeAbs, .yaw = modeVelocity};
  static const setpoint_mode_t place = {.x = modeAbs, .y = modeAbs, .z = modeAbs, .quat = modeAbs};
  const struct {
    const char *what;
    setpoint_t sp;
    unsigned want;
  } row[] = {
      {"nothing", {.timestamp = 0}, 0},
      {"by hand", {.mode = by_hand, .attitudeRate.yaw = 9.0f}, 0},
      {"rate of roll", {.mode = {.roll = modeVelocity, .pitch = modeAbs}}, NOT_FLOWN_RATES},
      {"rate of pitch", {.mode = {.roll = modeAbs, .pitch = modeVelocity}}, NOT_FLOWN_RATES},
      {"full state", {.mode = place}, 0},
      {"with a rate of yaw", {.mode = place, .attitudeRate.yaw = 9.0f}, 0},
      {"with a rate of roll", {.mode = place, .attitudeRate.roll = 9.0f}, NOT_FLOWN_TURN},
      {"with a rate of pitch", {.mode = place, .attitudeRate.pitch = -9.0f}, NOT_FLOWN_TURN},
      {"quaternion alone", {.mode = {.quat = modeAbs}}, NOT_FLOWN_QUAT},
      {"quaternion and x", {.mode = {.x = modeAbs, .quat = modeAbs}}, NOT_FLOWN_QUAT},
      {"quaternion and y", {.mode = {.y = modeAbs, .quat = modeAbs}}, NOT_FLOWN_QUAT},
      {"rates and quaternion",
       {.mode = {.roll = modeVelocity, .quat = modeAbs}},
       NOT_FLOWN_RATES | NOT_FLOWN_QUAT},
      {"rates, full state",
       {.mode = {.x = modeAbs, .y = modeAbs, .roll = modeVelocity, .quat = modeAbs},
        .attitudeRate.roll = 1.0f},
       NOT_FLOWN_RATES | NOT_FLOWN_TURN},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK(units_not_flown(&row[i].sp) == row[i].want);
    flight_setpoint_t sp; // level, whatever stands in its angles
    setpoint_t tilted = row[i].sp;
    tilted.attitude.roll = tilted.attitude.pitch = 20.0f;
    units_setpoint(&sp, &tilted);
    if (row[i].want != 0) CHECK(sp.roll_rad == 0.0f && sp.pitch_rad == 0.0f);
  }
}

TEST(app_knows_what_each_mode_of_the_power_distribution_does_to_the_motors) {
  stand_in = &around;
  const float unit = 0.12f / 65535.0f;
  float force_N[MOTORS];
  // Legacy: front right, back right, back left, front left get t -+ r/2 +- p/2 +- yaw.
  units_applied(force_N,
                &(control_t){.roll = 200, .pitch = 40, .yaw = 7, .thrust = 30000.0f, .controlMode = 0});
  CHECK_NEAR(force_N[0] / unit, 30000 - 100 + 20 + 7, 0.01);
  CHECK_NEAR(force_N[1] / unit, 30000 - 100 - 20 - 7, 0.01);
  CHECK_NEAR(force_N[2] / unit, 30000 + 100 - 20 + 7, 0.01);
  CHECK_NEAR(force_N[3] / unit, 30000 + 100 + 20 - 7, 0.01);
  // Force and torque: what our own mixer makes of the same.
  const mixer_param_t mixer = {.arm_m = 0.70710678f * 0.046f, .yaw_m = 0.00735f, .force_max_N = 0.12f};
  const mixer_out_t want = mixer_mix(&mixer, (v3_t){4e-4f, -3e-4f, 5e-5f}, 0.3f);
  control_t control = {.thrustSi = 0.3f, .torqueX = 4e-4f, .torqueY = -3e-4f, .torqueZ = 5e-5f};
  control.controlMode = controlModeForceTorque;
  units_applied(force_N, &control);
  for (int i = 0; i < MOTORS; i++) CHECK_NEAR(force_N[i], want.force_N[i], 1e-7);
  // A mode that is none of them: nothing is known of it.
  control = (control_t){.thrust = 30000.0f, .controlMode = (control_mode_t)7};
  units_applied(force_N, &control);
  for (int i = 0; i < MOTORS; i++) CHECK(force_N[i] == 0.0f);
  // Forces: there and back; what is no number is nothing.
  units_command(&control, (const float[MOTORS]){0.06f, 0.2f, -1.0f, NAN});
  CHECK(control.controlMode == controlModeForce);
  static const float share[MOTORS] = {0.5f, 1.0f, 0.0f, 0.0f};
  for (int i = 0; i < MOTORS; i++) CHECK(control.normalizedForces[i] == share[i]);
  units_applied(force_N, &control);
  CHECK_NEAR(force_N[0], 0.06, 1e-8);
  CHECK(force_N[1] == 0.12f && force_N[2] == 0.0f && force_N[3] == 0.0f);
}

TEST(app_finds_new_range_samples_in_a_value_without_a_time) {
  range_up_t s = {.started = false};
  const uint32_t start = 0xfffffff0u; // the counter wraps on the way
  int n = 0, odd = 0;
  double late_s = 0.0;
  for (uint32_t ms = 0; ms < 2000; ms++) {
    // A sample every 100 ms; the same value twice in a row now and then.
    const float mm = ms < 100 ? 0.0f : 100.0f + (float)(ms / 100 / 3);
    const range_up_sample_t got = range_up_poll(&s, mm, start + ms);
    if (!got.is_new) continue;
    n++;
    if (mm > 0.0f && fabsf(got.range_m - 0.001f * mm) > 1e-6f) odd++;
    // The instant that the age points at is 70 ms before one of the changes.
    const double measured_s = 1e-3 * ms - (double)got.age_s + 0.07;
    late_s = fmax(late_s, fabs(measured_s - 0.1 * round(measured_s / 0.1)));
  }
  CHECK(n >= 18 && n <= 20);
  CHECK(odd == 0);
  CHECK(late_s <= 0.0011);
}

TEST(app_catches_up_with_the_range_sensor_after_a_pause) {
  range_up_t s = {.started = false};
  CHECK(range_up_poll(&s, 500.0f, 1000).is_new);
  CHECK(!range_up_poll(&s, 500.0f, 1119).is_new);
  CHECK(range_up_poll(&s, 500.0f, 1120).is_new); // its time was 1100
  CHECK(s.at_ms == 1100);
  CHECK(range_up_poll(&s, 500.0f, 1299).is_new && s.at_ms == 1200);
  CHECK(range_up_poll(&s, 500.0f, 1400).is_new && s.at_ms == 1380); // when there were others nobody knows
  CHECK(!range_up_poll(&s, 500.0f, 1499).is_new);
  CHECK(range_up_poll(&s, 500.0f, 1500).is_new);
}

TEST(app_reports_a_range_sensor_that_never_started_as_samples_of_zero) {
  range_up_t s = {.started = false};
  int n = 0;
  for (uint32_t ms = 0; ms < 1000; ms++) {
    const range_up_sample_t got = range_up_poll(&s, 0.0f, ms);
    n += got.is_new;
    if (got.is_new) CHECK(got.range_m == 0.0f);
  }
  CHECK(n >= 8 && n <= 9);
}

TEST(app_counts_no_motor_with_more_than_it_can_give_or_with_less_than_nothing) {
  stand_in = &around;
  static const control_t beyond[] = {
      {.normalizedForces = {1.5f, -0.5f, 1.5f, -0.5f}, .controlMode = controlModeForce},
      {.yaw = 30000, .thrust = 40000.0f, .controlMode = controlModeLegacy},
      {.thrustSi = 0.24f, .torqueZ = -0.00735f, .controlMode = controlModeForceTorque},
  };
  for (unsigned i = 0; i < sizeof beyond / sizeof *beyond; i++) {
    ROW("mode %d", (int)beyond[i].controlMode);
    float force_N[MOTORS];
    units_applied(force_N, &beyond[i]);
    CHECK(force_N[0] == 0.12f && force_N[2] == 0.12f);
    CHECK(beyond[i].controlMode == controlModeLegacy || (force_N[1] == 0.0f && force_N[3] == 0.0f));
  }
}

TEST(app_takes_the_heading_from_a_quaternion_however_it_leans) {
  stand_in = &around;
  static const struct {
    float yaw, pitch, roll; // rad, turned in this order
  } row[] = {
      {0.7f, 0.0f, 0.0f}, {0.7f, 0.3f, 0.0f}, {0.7f, 0.0f, 0.4f}, {-2.5f, -0.5f, 0.6f}, {3.0f, 0.4f, -0.5f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    const float cy = cosf(0.5f * row[i].yaw), sy = sinf(0.5f * row[i].yaw), cp = cosf(0.5f * row[i].pitch),
                sp = sinf(0.5f * row[i].pitch), cr = cosf(0.5f * row[i].roll), sr = sinf(0.5f * row[i].roll);
    const setpoint_t asked = {.mode = {.quat = modeAbs, .x = modeAbs, .y = modeAbs, .z = modeAbs},
                              .attitudeQuaternion = {.w = cr * cp * cy + sr * sp * sy,
                                                     .x = sr * cp * cy - cr * sp * sy,
                                                     .y = cr * sp * cy + sr * cp * sy,
                                                     .z = cr * cp * sy - sr * sp * cy}};
    flight_setpoint_t got;
    units_setpoint(&got, &asked);
    CHECK(got.yaw == YAW_ANGLE);
    CHECK_NEAR(got.yaw_rad, row[i].yaw, 1e-3);
  }
}
