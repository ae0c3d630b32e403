// test_planner.c - high-level commands as packets, and the set points that they make.
#include "crazyflie/planner.h"
#include "rig/test.h"
#include <string.h>

enum { NOW = 5000 };

static planner_t at(float x_m, float z_m, float yaw_deg) {
  planner_t p;
  planner_init(&p);
  const state_t state = {.position = {0, x_m, 0.0f, z_m}, .attitude.yaw = yaw_deg};
  planner_tell(&p, &state);
  return p;
}

// A command of bytes and floats: 'b' and 'f'.
static int send(planner_t *p, uint8_t command, const char *kinds, const double *values) {
  uint8_t packet[30] = {command};
  int n = 1;
  for (int i = 0; kinds[i]; i++) {
    const float real = (float)values[i];
    const uint8_t byte = (uint8_t)values[i];
    memcpy(packet + n, kinds[i] == 'f' ? (const void *)&real : (const void *)&byte, kinds[i] == 'f' ? 4 : 1);
    n += kinds[i] == 'f' ? 4 : 1;
  }
  return planner_command(p, packet, n, NOW);
}
#define SEND(p, command, kinds, ...) send(p, command, kinds, (const double[]){__VA_ARGS__})

static setpoint_t after(planner_t *p, double s) {
  setpoint_t set = {.thrust = -1.0f};
  const state_t state = {.position = {0, 0.0f, 0.0f, 0.0f}};
  CHECK(planner_setpoint(p, &state, NOW + (uint32_t)(1e3 * s), &set));
  return set;
}

TEST(planner_flies_what_it_is_told) {
  static const struct {
    const char *what;
    uint8_t command;
    const char *kinds;
    double values[8], at_s, x_m, y_m, z_m, yaw_deg;
  } row[] = {
      {"take off", 7, "bffbf", {0, 1.2, 0.5, 0, 2}, 2, 0.5, 0, 1.2, 28.64789},
      {"take off, heading kept", 7, "bffbf", {0, 1.2, 0.5, 1, 2}, 2, 0.5, 0, 1.2, 10},
      {"take off, half way", 7, "bffbf", {0, 1.2, 0, 1, 2}, 1, 0.5, 0, 0.7, 10},
      {"take off, the old way", 1, "bff", {0, 0.7, 2}, 2, 0.5, 0, 0.7, 0},
      {"take off at 0.5 m/s by 1 m", 9, "bfbfbf", {0, 1.0, 1, 0, 1, 0.5}, 2, 0.5, 0, 1.2, 10},
      {"take off at the usual speed", 9, "bfbfbf", {0, 1.2, 0, 0, 1, 0}, 2, 0.5, 0, 1.2, 10},
      {"land", 8, "bffbf", {0, 0.0, 0, 1, 1}, 1, 0.5, 0, 0.0, 10},
      {"go to", 12, "bbbfffff", {0, 0, 0, 1, 2, 3, 0, 4}, 4, 1, 2, 3, 0},
      {"spiral of half a turn",
       11,
       "bbbfffff",
       {0, 0, 0, 3.14159265, 1, 1, 0.5, 4},
       4,
       0.5 - 0.347296,
       1.969616,
       0.7,
       190},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    planner_t p = at(0.5f, 0.2f, 10.0f);
    CHECK_NEAR(send(&p, row[i].command, row[i].kinds, row[i].values), 0, 0);
    const setpoint_t set = after(&p, row[i].at_s);
    CHECK_NEAR(set.position.x, row[i].x_m, 1e-4);
    CHECK_NEAR(set.position.y, row[i].y_m, 1e-4);
    CHECK_NEAR(set.position.z, row[i].z_m, 1e-4);
    CHECK_NEAR(set.attitude.yaw, row[i].yaw_deg, 1e-2);
    CHECK(set.mode.x == modeAbs && set.mode.z == modeAbs && set.mode.yaw == modeAbs);
  }
}

TEST(planner_goes_on_from_where_it_is_on_its_way) {
  planner_t p = at(0.0f, 1.0f, 0.0f);
  CHECK_NEAR(SEND(&p, 12, "bbbfffff", 0, 0, 0, 2, 0, 1, 0, 4), 0, 0);
  const setpoint_t before = after(&p, 2.0);
  CHECK(before.velocity.x > 0.5f);
  uint8_t packet[24] = {12, 0, 1}; // relative, by nothing, in 2 s
  const float two = 2.0f;
  memcpy(packet + 20, &two, 4);
  CHECK_NEAR(planner_command(&p, packet, sizeof packet, NOW + 2000), 0, 0);
  const setpoint_t now = after(&p, 2.0), end = after(&p, 4.0);
  CHECK_NEAR(now.position.x, before.position.x, 1e-5);
  CHECK_NEAR(now.velocity.x, before.velocity.x, 1e-5);
  CHECK_NEAR(end.position.x, before.position.x, 1e-4);
  CHECK_NEAR(end.velocity.x, 0.0, 1e-4);
}

TEST(planner_is_idle_after_a_landing_and_says_nothing_is_wanted) {
  planner_t p = at(0.0f, 1.0f, 0.0f);
  CHECK_NEAR(SEND(&p, 8, "bffbf", 0, 0, 0, 1, 2), 0, 0);
  (void)after(&p, 1.0);
  CHECK(planner_active(&p) && !planner_finished(&p, NOW + 1000));
  (void)after(&p, 2.1);
  const setpoint_t idle = after(&p, 2.2);
  CHECK(!planner_active(&p) && idle.mode.z == modeDisable && idle.thrust == 0.0f);
}

TEST(planner_answers_what_it_does_not_do) {
  static const struct {
    const char *what;
    uint8_t bytes[26];
    int size, want;
    bool blocked, flying;
  } row[] = {
      {"nothing", {0}, 0, 8, false, false},
      {"no such command", {99, 0}, 20, 8, false, false},
      {"a take-off cut short", {7, 0, 0, 0}, 4, 8, false, false},
      {"a go-to cut short", {12, 0, 0, 0}, 23, 8, false, false},
      {"blocked by the supervisor", {7}, 15, 16, true, false},
      {"a stop while blocked", {3, 0}, 2, 0, true, false},
      {"a take-off in flight", {7}, 15, 1, false, true},
      {"a definition of too high a number", {6, 10}, 9, 8, false, false},
      {"a trajectory that is not there", {13, 0, 0, 0, 0, 3}, 10, 0, false, false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    planner_t p = at(0.0f, 0.5f, 0.0f);
    if (row[i].flying) CHECK_NEAR(SEND(&p, 12, "bbbfffff", 0, 0, 0, 2, 0, 1, 0, 4), 0, 0);
    planner_block(&p, row[i].blocked);
    CHECK_NEAR(planner_command(&p, row[i].bytes, row[i].size, NOW), row[i].want, 0);
    CHECK(planner_active(&p) == row[i].flying);
  }
}

TEST(planner_minds_its_groups) {
  planner_t p = at(0.0f, 0.0f, 0.0f);
  CHECK_NEAR(SEND(&p, 0, "b", 2), 0, 0);
  CHECK_NEAR(SEND(&p, 7, "bffbf", 4, 1, 0, 1, 2), 0, 0);
  CHECK(!planner_active(&p));
  CHECK_NEAR(SEND(&p, 7, "bffbf", 6, 1, 0, 1, 2), 0, 0);
  CHECK(planner_active(&p));
}

TEST(planner_flies_an_uploaded_trajectory_from_where_it_is) {
  planner_t p = at(1.0f, 0.5f, 0.0f);
  const goal_t from = {{3.0f, 0.0f, 2.0f, 0.0f}, {0.0f}, {0.0f}},
               to = {{4.0f, 0.0f, 2.5f, 0.0f}, {0.0f}, {0.0f}};
  const piece_t piece = piece_between(&from, &to, 2.0f);
  memcpy(p.memory + 132, &piece, TRAJECTORY_PIECE_BYTES);
  const uint8_t define[] = {6, 1, 1, 0, 132, 0, 0, 0, 1};
  CHECK_NEAR(planner_command(&p, define, sizeof define, NOW), 0, 0);
  CHECK_NEAR(SEND(&p, 13, "bbbbbf", 0, 1, 0, 0, 1, 1), 0, 0);
  const setpoint_t begin = after(&p, 0.0), end = after(&p, 2.5);
  CHECK_NEAR(begin.position.x, 1.0, 1e-5);
  CHECK_NEAR(end.position.x, 2.0, 1e-5);
  CHECK_NEAR(end.position.z, 1.0, 1e-5);
}
