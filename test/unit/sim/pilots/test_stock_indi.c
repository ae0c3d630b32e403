// test_stock_indi.c - the firmware's own INDI as a peer. Each of its eight faults is shown to be there: these
// rows say why our controller differs. Where they show best, the stock PID flies the same and does not fail.
#include "crazyflie/stock_indi.h"
#include "crazyflie/stock_pid.h"
#include "rig/rig6.h"
#include "rig/test.h"

#include <string.h>

#define TURN 6.283185307179586
#define G    9.81

typedef struct {
  stock_indi_t indi;
  stock_pid_t pid;
  pilot_t pilot;
  rig6_t rig;
} flight_t6;

static void start(flight_t6 *f, bool indi, d3_t pos_w_m, double yaw_rad) {
  const stock_indi_param_t indi_param = stock_indi_default();
  const stock_pid_param_t pid_param = stock_pid_default();
  const rig6_param_t body = rig6_crazyflie();
  f->pilot = indi ? stock_indi_pilot(&f->indi, &indi_param) : stock_pid_pilot(&f->pid, &pid_param);
  f->rig = rig6_at(&body, pos_w_m, yaw_rad, true);
}

static void fly(flight_t6 *f, const pilot_setpoint_t *set, double seconds) {
  rig6_fly(&f->rig, &f->pilot, set, seconds, NULL, NULL);
}

// Started, and settled above a place at 1 m.
static void hover(flight_t6 *f, bool indi, double yaw_rad) {
  start(f, indi, (d3_t){0, 0, 1}, yaw_rad);
  const pilot_setpoint_t here = rig6_hold((d3_t){0, 0, 1}, yaw_rad);
  fly(f, &here, 12.0);
}

TEST(stock_indi_hovers_and_takes_steps) {
  static const struct {
    const char *what;
    d3_t to;
    double yaw_rad;
  } row[] = {
      {"hover", {0, 0, 1}, 0},
      {"up half a metre", {0, 0, 1.5}, 0},
      {"sideways", {0.3, -0.3, 1}, 0},
      {"sideways and turned", {0.3, 0, 1}, TURN / 4},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flight_t6 f;
    hover(&f, true, 0.0);
    const pilot_setpoint_t set = rig6_hold(row[i].to, row[i].yaw_rad);
    fly(&f, &set, 20.0);
    CHECK_NEAR(f.rig.pos_w_m.x, row[i].to.x, 0.002);
    CHECK_NEAR(f.rig.pos_w_m.y, row[i].to.y, 0.002);
    CHECK_NEAR(f.rig.pos_w_m.z, row[i].to.z, 0.002);
    CHECK_NEAR(rig6_yaw_rad(&f.rig), row[i].yaw_rad, 0.01);
  }
}

TEST(stock_indi_first_increments_are_those_by_hand) {
  // At rest and level, 0.1 m under and 0.1 m left of the set point, filters at rest: the 8 Hz filter lets
  // b = tan^2(...)/n of the specific force through, so that the rest of it looks like an error.
  flight_t6 f;
  start(&f, true, (d3_t){0, 0, 1}, 0.0);
  const pilot_setpoint_t set = rig6_hold((d3_t){0, -0.1, 1.1}, 0.0);
  fly(&f, &set, 0.001);
  const double k = tan(TURN / 2 * 8.0 / 500.0), b = k * k / (1 + sqrt(2.0) * k + k * k);
  const double up_mps2 = 5.0 * 0.1 + G - b * G;
  CHECK_NEAR(f.indi.position.thrust, fmin(up_mps2 / 2.473e-4, 60000.0), 1e-6);
  CHECK_NEAR(f.indi.position.roll_rad, 5.0 * 0.1 / G, 1e-9);
  CHECK_NEAR(f.indi.u_in[0], 24.0 * 5.0 * (0.5 / G) / 0.0066146, 1e-6);
}

TEST(stock_indi_fault_1_yaw_rate_drives_the_nose_to_heading_0) {
  for (int indi = 0; indi < 2; indi++) {
    ROW("%s", indi ? "INDI" : "PID");
    flight_t6 f;
    hover(&f, indi, 1.0);
    pilot_setpoint_t set = rig6_hold((d3_t){0, 0, 1}, 1.0);
    set.yaw_by_rate = true;
    fly(&f, &set, 5.0);
    CHECK_NEAR(rig6_yaw_rad(&f.rig), indi ? 0.0 : 1.0, 0.02); // nobody asked for a turn
  }
}

TEST(stock_indi_fault_2_yaw_error_is_not_wrapped) {
  for (int indi = 0; indi < 2; indi++) {
    ROW("%s", indi ? "INDI" : "PID");
    flight_t6 f;
    hover(&f, indi, 175.0 / STOCK_DEG);
    const pilot_setpoint_t set = rig6_hold((d3_t){0, 0, 1}, 185.0 / STOCK_DEG); // 10 degrees to the left
    fly(&f, &set, 0.3);
    CHECK(indi ? f.rig.rate_b_radps.z < -2.0 : f.rig.rate_b_radps.z > 0.1);
  }
}

TEST(stock_indi_fault_3_body_velocity_is_taken_for_world_velocity) {
  for (int indi = 0; indi < 2; indi++) {
    ROW("%s", indi ? "INDI" : "PID");
    flight_t6 f;
    hover(&f, indi, TURN / 4); // nose along y
    pilot_setpoint_t set = rig6_go((d3_t){0.3, 0, 0}, 1.0, TURN / 4);
    set.vel_in_body = true;
    fly(&f, &set, 4.0);
    CHECK_NEAR(f.rig.vel_w_mps.x, indi ? 0.3 : 0.0, 0.03);
    CHECK_NEAR(f.rig.vel_w_mps.y, indi ? 0.0 : 0.3, 0.03);
  }
}

TEST(stock_indi_fault_4_degrees_are_radians_without_the_position_loop) {
  flight_t6 f;
  start(&f, true, (d3_t){0, 0, 1}, 0.0);
  f.indi.param.outer = false;
  const pilot_setpoint_t set = rig6_hold((d3_t){0.02, 0, 1}, 0.0);
  fly(&f, &set, 0.001);
  // The cascade wants 25.01 x 0.04 degrees, nose down; the inner loop understands a radian.
  CHECK_NEAR(f.indi.angle_rad[1], -25.01 * 0.04, 1e-6);
  CHECK_NEAR(f.indi.u_in[1], fmax(-24.0 * 5.0 * 25.01 * 0.04 / 0.0052125, -32000.0), 1.0);
  fly(&f, &set, 1.0);
  CHECK(rig6_tilt_rad(&f.rig) > 0.7 || fabs(f.rig.pos_w_m.x) > 0.3); // for a set point 2 cm away
}

TEST(stock_indi_fault_5_integrates_on_the_ground_and_is_never_reset) {
  flight_t6 f;
  start(&f, true, (d3_t){0, 0, 0}, 0.0);
  rig6_param_t body = rig6_crazyflie();
  body.floor = true;
  body.acc_bias_b_mps2.z = -0.01 * G;
  f.rig = rig6_at(&body, (d3_t){0, 0, 0}, 0.0, false);
  const pilot_setpoint_t off = {.thrust_N = 0.0}, here = rig6_hold((d3_t){0, 0, 0}, 0.0);
  fly(&f, &off, 30.0);
  for (int i = 0; i < 4; i++) CHECK(f.rig.command_N[i] == 0.0);
  // Stay where you are, it is told.
  fly(&f, &here, 0.001);
  CHECK_NEAR(f.indi.command.thrust, 60000.0, 1e-9);
  stock_indi_select(&f.indi);
  CHECK(f.indi.position.lagged_thrust > 59000.0);
}

TEST(stock_indi_fault_6_accelerometer_bias_is_a_height_error) {
  static const double bias_g[3] = {-0.01, 0.01, 0.02};
  for (int i = 0; i < 3; i++) {
    ROW("%g g", bias_g[i]);
    flight_t6 f;
    start(&f, true, (d3_t){0, 0, 1}, 0.0);
    f.rig.param.acc_bias_b_mps2.z = bias_g[i] * G;
    const pilot_setpoint_t set = rig6_hold((d3_t){0, 0, 1}, 0.0);
    fly(&f, &set, 25.0);
    CHECK_NEAR(f.rig.pos_w_m.z - 1.0, -bias_g[i] * G / 5.0, 2e-4); // b/(kp kd): 2 cm for 0.01 g
  }
}

TEST(stock_indi_fault_7_feed_forward_is_dropped) {
  flight_t6 with, without;
  hover(&with, true, 0.0);
  hover(&without, true, 0.0);
  const pilot_setpoint_t still = rig6_hold((d3_t){0, 0, 1}, 0.0);
  pilot_setpoint_t moving = still;
  moving.vel_mps = (d3_t){1.0, -1.0, 0.5};
  moving.acc_w_mps2 = (d3_t){2.0, 2.0, 2.0};
  fly(&with, &moving, 2.0);
  fly(&without, &still, 2.0);
  CHECK(memcmp(&with.rig.pos_w_m, &without.rig.pos_w_m, sizeof(d3_t)) == 0);
  CHECK(memcmp(&with.indi.command, &without.indi.command, sizeof(stock_command_t)) == 0);
}

TEST(stock_indi_fault_8_cut_offs_act_only_after_selection) {
  flight_t6 stock, tuned;
  hover(&stock, true, 0.0);
  hover(&tuned, true, 0.0);
  tuned.indi.param.cutoff_Hz = tuned.indi.param.position.cutoff_Hz = 20.0;
  const pilot_setpoint_t set = rig6_hold((d3_t){0.3, 0, 1.2}, 0.5);
  fly(&stock, &set, 1.0);
  fly(&tuned, &set, 1.0);
  CHECK(memcmp(&stock.rig.pos_w_m, &tuned.rig.pos_w_m, sizeof(d3_t)) == 0);
  stock_indi_select(&stock.indi);
  stock_indi_select(&tuned.indi);
  fly(&stock, &set, 1.0);
  fly(&tuned, &set, 1.0);
  CHECK(fabs(stock.rig.pos_w_m.z - tuned.rig.pos_w_m.z) > 1e-3);
}
