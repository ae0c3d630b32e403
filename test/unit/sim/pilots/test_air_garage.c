// test_air_garage.c - the air garage's thrust division as a peer.
#include "pilots/air_garage.h"
#include "rig/rig6.h"
#include "rig/test.h"

#include <string.h>

TEST(air_garage_ratios_are_those_of_its_tables) {
  static const struct {
    double in_R, ceiling, ground; // 0: not in the table
    double near_ceiling, near_ground;
  } row[] = {
      {0.1, 2.337, 0, 1.11, 2.0},  {0.25, 1.37, 0, 1.11, 2.0},    {0.5, 1.11, 1.33, 1.11, 2.0},
      {0.501, 0, 0, 1.112, 1.332}, {1.0, 1.03, 1.07, 1.03, 1.07},
  };
  const air_garage_param_t early = air_garage_2024(), late = air_garage_2025();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g R", row[i].in_R);
    const double d = row[i].in_R * early.radius_m;
    // The tables have two decimals.
    if (row[i].ceiling > 0.0) CHECK_NEAR(air_garage_ceiling_ratio(&late, d), row[i].ceiling, 0.005);
    if (row[i].ground > 0.0) CHECK_NEAR(air_garage_ground_ratio(&late, d), row[i].ground, 0.005);
    CHECK_NEAR(air_garage_ceiling_ratio(&early, d), row[i].near_ceiling, 0.005);
    CHECK_NEAR(air_garage_ground_ratio(&early, d), row[i].near_ground, 0.005);
  }
}

// The pilot's motors for the very first tick, at this height, leaning by this much to the right.
static void first(const air_garage_param_t *p, double z_m, double lean_rad, double motor_N[4]) {
  air_garage_t s;
  const pilot_t pilot = air_garage_pilot(&s, p);
  const pilot_in_t in = {
      .pos_w_m = {0, 0, z_m},
      .q_wb = {cos(0.5 * lean_rad), sin(0.5 * lean_rad), 0, 0},
      .vbat_V = 4.2,
      .set = rig6_hold((d3_t){0, 0, z_m}, 0.0),
  };
  pilot.step(pilot.state, &in, motor_N);
}

TEST(air_garage_divides_the_thrust_by_both_ratios) {
  air_garage_param_t p = air_garage_2024();
  double free_N[4], between_N[4];
  first(&p, 1.0, 0.0, free_N);
  p.ceiling_m = 1.0 + p.radius_m;
  p.ground_m = 1.0 - 0.6 * p.radius_m;
  const double both =
      air_garage_ceiling_ratio(&p, p.radius_m) * air_garage_ground_ratio(&p, 0.6 * p.radius_m);
  first(&p, 1.0, 0.0, between_N);
  for (int i = 0; i < 4; i++) CHECK_NEAR(between_N[i], free_N[i] / both, 1e-5); // 16-bit duty
  p.how = AIR_GARAGE_PER_ROTOR;
  first(&p, 1.0, 0.0, between_N);
  for (int i = 0; i < 4; i++) CHECK_NEAR(between_N[i], free_N[i] / sqrt(both), 1e-5);
}

TEST(air_garage_without_surfaces_is_the_stock_pid) {
  const rig6_param_t body = rig6_crazyflie();
  const air_garage_param_t param = air_garage_2024();
  air_garage_t s;
  stock_pid_t pid;
  const pilot_t pilots[2] = {air_garage_pilot(&s, &param), stock_pid_pilot(&pid, &param.pid)};
  rig6_t r[2];
  for (int i = 0; i < 2; i++) {
    r[i] = rig6_at(&body, (d3_t){0, 0, 1}, 0.0, true);
    const pilot_setpoint_t set = rig6_hold((d3_t){0.02, 0.01, 1.03}, 0.03); // no motor at a limit
    rig6_fly(&r[i], &pilots[i], &set, 3.0, NULL, NULL);
  }
  CHECK(memcmp(&r[0].pos_w_m, &r[1].pos_w_m, sizeof r[0].pos_w_m) == 0);
}

TEST(air_garage_per_rotor_has_the_rotors_one_arm_off) {
  // Leaning to the right, the left rotors m3 and m4 are nearer to the ceiling. It divides m1 and m4 by more.
  air_garage_param_t p = air_garage_2025();
  double free_N[4], under_N[4];
  first(&p, 1.0, 0.1, free_N);
  p.ceiling_m = 1.01;
  first(&p, 1.0, 0.1, under_N);
  const double left = under_N[0] / free_N[0], right = under_N[1] / free_N[1];
  CHECK(left < right - 0.02);
  CHECK_NEAR(under_N[3] / free_N[3], left, 2e-3);  // m4: rightly; duty is 16-bit and roll commands are cut
  CHECK_NEAR(under_N[2] / free_N[2], right, 2e-3); // m3: wrongly
}

TEST(air_garage_stops_where_its_ground_form_has_no_value) {
  air_garage_param_t p = air_garage_2025();
  double motor_N[4];
  p.ground_m = 1.0 - 0.2 * p.radius_m;
  first(&p, 1.0, 0.0, motor_N);
  for (int i = 0; i < 4; i++) CHECK(motor_N[i] == 0.0);
}

static void keep_highest(const rig6_t *r, void *highest_m) {
  double *const z_m = highest_m;
  *z_m = fmax(*z_m, r->pos_w_m.z);
}

TEST(air_garage_is_not_caught_by_the_ceiling_where_the_stock_pid_is) {
  // From 60 mm to 20 mm under a plate whose ratio is the one it believes. R of both: 23 mm.
  rig6_param_t body = rig6_crazyflie();
  body.ceiling_m = 1.0;
  body.radius_m = 0.023;
  air_garage_param_t param = air_garage_2024();
  param.ceiling_m = 1.0;
  air_garage_t s;
  stock_pid_t pid;
  const pilot_t pilots[2] = {stock_pid_pilot(&pid, &param.pid), air_garage_pilot(&s, &param)};
  double highest_m[2] = {0.0, 0.0}, end_m[2];
  for (int i = 0; i < 2; i++) {
    rig6_t r = rig6_at(&body, (d3_t){0, 0, 0.9}, 0.0, true);
    const pilot_setpoint_t far = rig6_hold((d3_t){0, 0, 0.94}, 0.0),
                           near = rig6_hold((d3_t){0, 0, 0.98}, 0.0);
    rig6_fly(&r, &pilots[i], &far, 10.0, NULL, NULL);
    rig6_fly(&r, &pilots[i], &near, 10.0, keep_highest, &highest_m[i]);
    end_m[i] = r.pos_w_m.z;
  }
  CHECK_NEAR(end_m[1], 0.98, 0.003);
  CHECK(highest_m[1] < 0.99);
  CHECK_NEAR(highest_m[0], 1.0 - RIG6_TOUCH_M, 1e-9);
  CHECK_NEAR(end_m[0], 1.0 - RIG6_TOUCH_M, 1e-9);
}
