// test_commanded.c - set points as packets, and who may set them.
#include "crazyflie/commanded.h"
#include "rig/test.h"
#include <string.h>

static int floats(uint8_t *packet, uint8_t kind, const float *values, int n) {
  packet[0] = kind;
  memcpy(packet + 1, values, (size_t)n * sizeof *values);
  return 1 + 4 * n;
}

static setpoint_t taken(uint8_t kind, const float values[4]) {
  static commanded_t c;
  uint8_t packet[30];
  commanded_init(&c);
  CHECK(commanded_take(&c, packet, floats(packet, kind, values, 4), 77));
  return c.set;
}

TEST(set_points_of_the_link_are_those_of_the_firmware) {
  const float v[] = {1.0f, 2.0f, 3.0f, 4.0f};
  const setpoint_t hover = taken(10, v), place = taken(7, v), height = taken(9, v), world = taken(8, v);
  CHECK(hover.mode.x == modeVelocity && hover.velocity_body && hover.mode.z == modeAbs);
  CHECK_NEAR(hover.velocity.y, 2, 0);
  CHECK_NEAR(hover.attitudeRate.yaw, 3, 0);
  CHECK_NEAR(hover.position.z, 4, 0);
  CHECK(place.mode.x == modeAbs && place.mode.yaw == modeAbs && place.timestamp == 77);
  CHECK_NEAR(place.position.z, 3, 0);
  CHECK_NEAR(place.attitude.yaw, 4, 0);
  CHECK(height.mode.roll == modeAbs && height.mode.x == modeDisable && height.mode.z == modeAbs);
  CHECK_NEAR(height.attitude.pitch, 2, 0);
  CHECK_NEAR(height.position.z, 4, 0);
  CHECK(world.mode.z == modeVelocity && !world.velocity_body);
  CHECK_NEAR(world.velocity.z, 3, 0);
  CHECK_NEAR(taken(5, v).attitudeRate.yaw, -3, 0); // the old hover turns the other way
}

TEST(a_full_state_has_its_attitude_packed) {
  commanded_t c;
  commanded_init(&c);
  uint8_t packet[29] = {6};
  const int16_t whole[] = {1500, -250, 800, 100, 0, 0, 0, 0, -9810};
  memcpy(packet + 1, whole, sizeof whole);
  // A quarter turn to the left: w and z are 1/sqrt(2), the greatest in size; w, number 3, is left out.
  const uint32_t bits = 3u << 30 | 511;
  memcpy(packet + 19, &bits, 4);
  CHECK(commanded_take(&c, packet, sizeof packet, 5));
  CHECK_NEAR(c.set.position.x, 1.5, 1e-6);
  CHECK_NEAR(c.set.position.y, -0.25, 1e-6);
  CHECK_NEAR(c.set.acceleration.z, -9.81, 1e-5);
  CHECK_NEAR(c.set.attitudeQuaternion.z, 0.70710678, 1e-6);
  CHECK_NEAR(c.set.attitudeQuaternion.w, 0.70710678, 1e-4);
  CHECK(c.set.mode.quat == modeAbs && c.set.mode.yaw == modeDisable);
}

TEST(what_is_no_set_point_changes_nothing) {
  static const struct {
    const char *what;
    uint8_t kind;
    float third;
    int size;
  } row[] = {
      {"nothing", 10, 3.0f, 0},         {"cut short", 10, 3.0f, 16},        {"not a number", 10, NAN, 17},
      {"without end", 8, INFINITY, 17}, {"of no known kind", 12, 3.0f, 17}, {"of a transmitter", 3, 3.0f, 17},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    commanded_t c, before;
    commanded_init(&c);
    before = c;
    uint8_t packet[30] = {0};
    (void)floats(packet, row[i].kind, (const float[]){1.0f, 2.0f, row[i].third, 4.0f}, 4);
    CHECK(!commanded_take(&c, packet, row[i].size, 9));
    CHECK(memcmp(&c, &before, sizeof c) == 0);
  }
}

static bool pad(commanded_t *c, float roll, float pitch, float yaw, uint16_t thrust) {
  uint8_t packet[14];
  const float values[] = {roll, pitch, yaw};
  memcpy(packet, values, sizeof values);
  memcpy(packet + 12, &thrust, 2);
  return commanded_take_pad(c, packet, sizeof packet, 3);
}

TEST(a_game_pad_is_locked_until_its_stick_was_down) {
  commanded_t c;
  commanded_init(&c);
  CHECK(pad(&c, 1.0f, 2.0f, 3.0f, 40000));
  CHECK(c.set.thrust == 0.0f);
  CHECK(pad(&c, 1.0f, 2.0f, 3.0f, 0) && pad(&c, 1.0f, 2.0f, 3.0f, 40000));
  CHECK_NEAR(c.set.thrust, 40000, 0);
  CHECK_NEAR(c.set.attitude.roll, 1, 0);
  CHECK_NEAR(c.set.attitudeRate.yaw, -3, 0);
  CHECK(pad(&c, 0.0f, 0.0f, 0.0f, 999) && c.set.thrust == 0.0f);
  c.pad.alt_hold = 1;
  CHECK(pad(&c, 0.0f, 0.0f, 0.0f, 65534));
  CHECK(c.set.mode.z == modeVelocity);
  CHECK_NEAR(c.set.velocity.z, 1, 1e-4);
  CHECK(!pad(&c, NAN, 0.0f, 0.0f, 0));
}

TEST(a_client_s_set_point_counts_before_the_planner_s_until_it_lets_go) {
  commanded_t c;
  commanded_init(&c);
  const state_t state = {.position.z = 0.3f};
  const uint8_t up[15] = {7, 0, 0, 0, 0x80, 0x3f, 0, 0, 0, 0, 1, 0, 0, 0, 0x40}; // 1 m in 2 s
  uint8_t hover[17];
  CHECK_NEAR(planner_command(&c.planner, up, sizeof up, 0), 0, 0);
  CHECK(commanded_now(&c, &state, true, 0, 1000).mode.z == modeAbs);
  (void)floats(hover, 10, (const float[]){0.0f, 0.0f, 0.0f, 0.7f}, 4);
  CHECK(commanded_take(&c, hover, sizeof hover, 1005));
  CHECK(!planner_active(&c.planner));
  CHECK_NEAR(commanded_now(&c, &state, true, 10, 1010).position.z, 0.7, 1e-6);
  CHECK_NEAR(commanded_now(&c, &state, true, 20, 1020).position.z, 0.7, 1e-6);
  commanded_relax(&c);
  CHECK(commanded_now(&c, &state, true, 30, 1030).mode.z == modeDisable); // the planner is idle
  CHECK_NEAR(c.planner.last.at[TRAJECTORY_Z], 0.3, 1e-6);
}

TEST(who_may_not_fly_has_no_plan) {
  commanded_t c;
  commanded_init(&c);
  const state_t state = {.position.z = 0.0f};
  uint8_t hover[17];
  (void)floats(hover, 10, (const float[]){0.0f, 0.0f, 0.0f, 0.7f}, 4);
  CHECK(commanded_take(&c, hover, sizeof hover, 1000));
  (void)commanded_now(&c, &state, false, 1, 1001);
  CHECK(c.planner.blocked);
}
