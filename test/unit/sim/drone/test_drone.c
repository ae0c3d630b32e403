// test_drone.c - a simulated vehicle flown through its link, in simulated time.
#include "crazyflie/values.h"
#include "flight/guard.h"
#include "rig/desk_drone.h"
#include "rig/test.h"
#include <math.h>
#include <string.h>

TEST(a_client_takes_off_hovers_and_lands_with_each_controller) {
  static const struct {
    const char *what;
    double controller, shadow;
  } row[] = {{"the app", 6, 0},
             {"the stock PID in its place", 6, 1},
             {"the stock PID", 1, 1},
             {"the stock INDI", 3, 1}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    drone_t *const d = desk_drone(3.0, NULL, NULL);
    desk_set(d, "stabilizer.controller", row[i].controller);
    desk_set(d, "ceil.shadow", row[i].shadow);
    desk_pass(d, 1.0);
    desk_climb(d, 0.6f);
    desk_pass(d, 8.0);
    CHECK_NEAR(d->seen.truth->pos_w_m.z - 0.017, 0.6, 0.05);
    CHECK(supervised_flies(&d->firmware.vehicle.supervised));
    desk_land(d);
    desk_pass(d, 7.0);
    CHECK_NEAR(d->seen.truth->pos_w_m.z - 0.017, 0.0, 0.01);
    CHECK(!supervised_flies(&d->firmware.vehicle.supervised));
    desk_end(d);
  }
}

TEST(the_controller_can_be_changed_in_flight) {
  drone_t *const d = desk_drone(3.0, NULL, NULL);
  desk_pass(d, 1.0);
  desk_climb(d, 0.6f);
  desk_pass(d, 5.0);
  static const double order[] = {1, 6, 1};
  for (int i = 0; i < 3; i++) {
    desk_set(d, "stabilizer.controller", order[i]);
    desk_pass(d, 3.0);
    ROW("to %g", order[i]);
    CHECK_NEAR(desk_log(d, "desk.z") - 0.017, 0.6, 0.08);
  }
  desk_set(d, "stabilizer.controller", 2); // there is none
  desk_pass(d, 0.1);
  CHECK_NEAR(d->firmware.params.stabilizer_controller, 1, 0);
  desk_end(d);
}

TEST(set_points_that_stop_coming_end_the_flight) {
  drone_t *const d = desk_drone(3.0, NULL, NULL);
  const float hover[] = {0.0f, 0.0f, 0.0f, 0.4f};
  uint8_t packet[18] = {0x7c, 10};
  memcpy(packet + 2, hover, sizeof hover);
  desk_pass(d, 1.0);
  for (int i = 0; i < 40; i++) {
    drone_take(d, packet, sizeof packet);
    desk_pass(d, 0.1);
  }
  CHECK_NEAR(desk_log(d, "desk.z") - 0.017, 0.4, 0.05);
  desk_pass(d, 1.0);
  CHECK(d->firmware.vehicle.supervised.state == SUPERVISED_LEVEL_OUT);
  desk_pass(d, 1.5);
  CHECK(d->firmware.vehicle.supervised.state == SUPERVISED_LOCKED);
  desk_set(d, "desk.restart", 1);
  desk_pass(d, 1.0);
  CHECK(supervised_can_fly(&d->firmware.vehicle.supervised));
  desk_end(d);
}

TEST(what_a_person_does_at_the_desk_is_felt) {
  drone_t *const d = desk_drone(1.0, NULL, NULL);
  desk_set(d, "ceil.shadow", 0);
  desk_pass(d, 1.0);
  desk_climb(d, 0.7f);
  desk_pass(d, 6.0);
  CHECK_NEAR(desk_log(d, "desk.gap"), 0.27, 0.02);
  why_t why;
  CHECK_OK(drone_set(d, "ceiling", 0.9, &why));
  desk_pass(d, 0.5);
  CHECK_NEAR(desk_log(d, "desk.gap"), 0.17, 0.02);
  const double x_m = desk_log(d, "desk.x");
  CHECK_OK(drone_set(d, "windX", 20.0, &why));
  desk_pass(d, 0.5);
  CHECK(desk_log(d, "desk.x") > x_m + 0.02);
  CHECK_OK(drone_set(d, "windX", 0.0, &why));
  desk_pass(d, 3.0);
  CHECK_OK(drone_set(d, "cover", 1.0, &why));
  desk_pass(d, 5.0);
  CHECK(d->firmware.vehicle.app.flight.guard.latched != 0);
  desk_end(d);
}

// They are what the firmware has in memory, and mean other things while the app flies
// (src/firmware/README.md).
TEST(the_firmware_s_logs_of_commands_are_those_of_the_vehicle) {
  drone_t *const d = desk_drone(3.0, NULL, NULL);
  const control_t *const control = &d->firmware.vehicle.control;
  desk_pass(d, 1.0);
  desk_climb(d, 0.6f);
  desk_pass(d, 4.0);
  const double units = desk_log(d, "stabilizer.thrust");
  CHECK(units > 2e4 && units < 6e4);
  CHECK_NEAR(desk_log(d, "controller.cmd_thrust"), units, 2000.0);
  CHECK_NEAR(desk_log(d, "controller.accelz"), 1.0, 0.3); // g
  CHECK(desk_log(d, "controller.rollRate") != 0.0);
  desk_set(d, "ceil.shadow", 0);
  desk_pass(d, 3.0);
  CHECK_NEAR(desk_log(d, "stabilizer.thrust"), (double)control->normalizedForces[2], 0.0);
  CHECK(control->normalizedForces[2] > 0.2f && control->normalizedForces[2] < 1.0f);
  static const char *const stand[] = {"controller.cmd_thrust", "controller.cmd_roll", "controller.rollRate",
                                      "controller.r_pitch",    "controller.accelz",   "controller.yaw"};
  for (unsigned i = 0; i < sizeof stand / sizeof *stand; i++) {
    ROW("%s", stand[i]);
    const double had = desk_log(d, stand[i]);
    desk_pass(d, 0.1);
    CHECK_NEAR(desk_log(d, stand[i]), had, 0.0);
  }
  desk_end(d);
}

static bool is_told(drone_t *d, const char *name, double value) {
  const int i = firmware_param_find(&d->firmware, name), type = firmware_param_row(&d->firmware, i).type;
  uint8_t bytes[4];
  values_put(type, bytes, value);
  bool told = false;
  for (packet_t p; link_give(&d->link, &p);)
    told = told || (p.byte[0] == 0x2f && p.byte[1] == 1 && p.byte[2] == (i & 255) && p.byte[3] == i >> 8 &&
                    memcmp(p.byte + 4, bytes, (size_t)link_param_bytes(type)) == 0);
  return told;
}

TEST(a_client_is_told_of_what_others_change) {
  drone_t *const d = desk_drone(1.0, NULL, NULL);
  why_t why;
  desk_pass(d, 0.1);
  CHECK_OK(drone_set(d, "ceiling", 0.5, &why));
  CHECK(is_told(d, "desk.ceiling", 0.5));
  desk_set(d, "stabilizer.controller", 2); // there is none
  CHECK_OK(drone_tick(d, &why));
  CHECK(is_told(d, "stabilizer.controller", 6));
  desk_set(d, "indiPos.kpz", 1.25);
  desk_set(d, "desk.restart", 1);
  CHECK(!is_told(d, "indiPos.kpz", 2.0));
  CHECK_OK(drone_tick(d, &why));
  CHECK(is_told(d, "indiPos.kpz", 2.0));
  desk_end(d);
}

TEST(a_log_block_goes_on_after_a_restart) {
  drone_t *const d = desk_drone(1.0, NULL, NULL);
  const int vbat = firmware_log_find(&d->firmware, "pm.vbat");
  desk_pass(d, 3.0);
  drone_take(d, (uint8_t[]){0x5d, 6, 1, 7, (uint8_t)vbat, (uint8_t)(vbat >> 8)}, 6);
  drone_take(d, (uint8_t[]){0x5d, 3, 1, 1}, 4);
  desk_pass(d, 1.0);
  desk_set(d, "desk.restart", 1);
  int rows = 0;
  why_t why;
  for (int i = 0; i < 100; i++) {
    CHECK_OK(drone_tick(d, &why));
    for (packet_t p; link_give(&d->link, &p);) rows += p.byte[0] == 0x5e;
  }
  CHECK_NEAR(rows, 20, 1);
  desk_end(d);
}

// It is pushed down, and not cut.
TEST(a_ceiling_that_is_lowered_onto_the_vehicle_leaves_it_whole) {
  static const double row[] = {0.15, 0.5, 0.8, 0.98};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("to %g m", row[i]);
    drone_t *const d = desk_drone(1.5, NULL, NULL);
    why_t why;
    desk_pass(d, 1.0);
    desk_climb(d, 1.0f);
    desk_pass(d, 4.0);
    CHECK_OK(drone_set(d, "ceiling", row[i], &why));
    desk_pass(d, 8.0);
    CHECK(d->finite);
    CHECK(desk_log(d, "desk.z") < row[i]);
    CHECK(fabs(desk_log(d, "desk.x")) < 1.5 && fabs(desk_log(d, "desk.y")) < 1.5);
    CHECK_OK(drone_set(d, "ceiling", 10.0, &why));
    desk_pass(d, 0.1);
    CHECK(desk_log(d, "desk.gap") > 5.0);
    desk_end(d);
  }
}

// It has handed over, fallen, and is armed anew, and its client sends all the time.
TEST(a_vehicle_that_handed_over_stays_down_while_its_client_sends) {
  drone_t *const d = desk_drone(3.0, NULL, NULL);
  const float hover[] = {0.0f, 0.0f, 0.0f, 0.4f};
  uint8_t packet[18] = {0x7c, 10};
  memcpy(packet + 2, hover, sizeof hover);
  desk_set(d, "ceil.shadow", 0);
  desk_pass(d, 1.0);
  bool armed_anew = false;
  for (int i = 0; i < 200; i++) {
    if (i == 40) d->firmware.vehicle.app.flight.guard.action = GUARD_HAND_OVER;
    if (i == 40) CHECK_NEAR(desk_log(d, "desk.z") - 0.017, 0.4, 0.05);
    drone_take(d, packet, sizeof packet);
    for (int ms = 0; ms < 100; ms += 2) {
      desk_pass(d, 0.002);
      armed_anew = armed_anew || (i > 60 && d->firmware.vehicle.supervised.state == SUPERVISED_ARMING);
    }
    if (i > 80) CHECK(desk_log(d, "desk.z") < 0.05);
  }
  CHECK(armed_anew);
  drone_take(d, (uint8_t[]){0x7c, 0}, 2); // it lets go
  desk_pass(d, 0.5);
  for (int i = 0; i < 50; i++) {
    drone_take(d, packet, sizeof packet);
    desk_pass(d, 0.1);
  }
  CHECK_NEAR(desk_log(d, "desk.z") - 0.017, 0.4, 0.05);
  desk_end(d);
}

TEST(what_may_not_be_done_at_the_desk_is_refused_with_its_range) {
  static const struct {
    const char *name;
    double value;
    const char *says;
  } row[] = {{"ceiling", 0.01, "desk.ceiling: allowed is a number from 0.15 to 10 m"},
             {"cover", 2.0, "desk.cover: allowed is a whole number from 0 to 1"},
             {"weakMotor", 2.5, "desk.weakMotor: allowed is a whole number from 0 to 4"},
             {"windX", (double)NAN, "desk.windX: allowed is a number from -100 to 100 mN"},
             {"wind", 0.0, "wind: there is no such parameter in the group desk"}};
  drone_t *const d = desk_drone(1.0, NULL, NULL);
  desk_pass(d, 0.1);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].name);
    why_t why;
    CHECK_STATUS(BAD_INPUT, drone_set(d, row[i].name, row[i].value, &why));
    CHECK_TEXT(why.text, row[i].says);
  }
  // Over the link: echoed, put back, told.
  desk_set(d, "desk.ceiling", 0.01);
  CHECK_NEAR(d->params.ceiling, 1.0, 1e-6);
  packet_t p;
  bool told = false;
  while (link_give(&d->link, &p)) told = told || (p.byte[0] == 0x2f && p.byte[1] == 1);
  CHECK(told);
  desk_end(d);
}
