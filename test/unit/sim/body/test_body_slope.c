// test_body_slope.c - six degrees of freedom on a floor that slopes, at a wall, and held.
#include "rig/turned.h"
#include "rig/vehicle6.h"

static model_t on_slope(double deg, double azimuth_rad) {
  model_t m = vehicle6(HUGE_VAL);
  const double rise = tan(deg * 3.14159265358979 / 180.0);
  m.floor_rise_x = rise * cos(azimuth_rad);
  m.floor_rise_y = rise * sin(azimuth_rad);
  return m;
}

TEST(body_stands_along_the_floor_whichever_way_it_slopes) {
  for (int k = 0; k < 8; k++) {
    ROW("uphill at %d deg", 45 * k);
    const model_t m = on_slope(5.0, 0.785398163397448 * k);
    const body_start_t start = body_standing(&m);
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, vehicle6_kinds[k % 2], 0.002, &start))) continue;
    vehicle6_fly(&b, 0.0, 1000);
    CHECK_NEAR(vehicle6_tilt_rad(&b), 5.0 * 3.14159265358979 / 180.0, 1e-4);
    CHECK_NEAR(body_clearance(&b).floor_m, 0.0, 2e-5);
    CHECK_NEAR(d3_norm(body_specific_force_b_mps2(&b)), 9.81, 1e-3);
    // Friction is a viscous one at first: it creeps downhill, and no faster than the grip lets it.
    const double creep_mps = 9.81 * sin(0.0872664626) / (4.0 * TOUCH_GRIP);
    CHECK_NEAR(d3_norm(d3_of(b.y + RIGID_VEL_MPS)), creep_mps, 0.05 * creep_mps);
    CHECK(b.y[RIGID_POS_M] * m.floor_rise_x + b.y[RIGID_POS_M + 1] * m.floor_rise_y < 0.0);
    CHECK(b.on_floor && b.floor_contacts == 0 && !b.broken);
    body_close(&b);
  }
}

TEST(body_slides_down_a_floor_that_is_steeper_than_its_friction) {
  const model_t m = on_slope(40.0, 0.0);
  const body_start_t start = body_standing(&m);
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  vehicle6_fly(&b, 0.0, 150); // g (sin - mu cos) for 0.3 s
  CHECK_NEAR(d3_norm(d3_of(b.y + RIGID_VEL_MPS)), 9.81 * (0.642788 - 0.5 * 0.766044) * 0.3, 0.02);
  body_close(&b);
}

TEST(ground_effect_counts_from_the_floor_below_each_rotor) {
  model_t m = on_slope(10.0, 0.0);
  vehicle6_add(&m, "ground");
  body_start_t start = {.pos_w_m = {0.0, 0.0, 0.03}};
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  CHECK(body_thrust_ratio(&b, 0) > body_thrust_ratio(&b, 1) + 0.002); // the front one is nearer
  CHECK_NEAR(body_thrust_ratio(&b, 0), body_thrust_ratio(&b, 3), 1e-12);
  body_close(&b);
}

TEST(body_does_not_go_through_a_wall) {
  static const double walls_m[] = {0.4, -0.4}, speeds_mps[] = {0.2, 1.0, 5.0};
  for (int w = 0; w < 2; w++)
    for (int s = 0; s < 3; s++) {
      ROW("wall at %g m, %g m/s", walls_m[w], speeds_mps[s]);
      model_t m = vehicle6(HUGE_VAL);
      m.wall_y_m = walls_m[w];
      m.wall_solid = true;
      const double side = walls_m[w] > 0.0 ? 1.0 : -1.0;
      body_start_t start = {.pos_w_m = {0.0, 0.0, 2.0}, .vel_w_mps = {0.0, side * speeds_mps[s], 0.0}};
      body_t b;
      if (!CHECK_OK(body_open(&b, &m, vehicle6_kinds[s % 2], 0.002, &start))) continue;
      double deepest_m = 0.0, farthest_m = 0.0;
      for (int t = 0; t < 300; t++) {
        vehicle6_fly(&b, 1.0, 1);
        deepest_m = fmin(deepest_m, body_clearance(&b).wall_m);
        farthest_m = fmax(farthest_m, side * b.y[RIGID_POS_M + 1]);
      }
      CHECK(deepest_m > -0.015);
      CHECK(farthest_m < 0.4);
      if (speeds_mps[s] >= 1.0) CHECK(deepest_m < 0.0); // it came there
      body_close(&b);
    }
}

TEST(body_that_is_held_stands_still_while_its_rotors_turn) {
  for (int k = 0; k < 2; k++) {
    ROW("kind %d", k);
    const model_t m = vehicle6(HUGE_VAL);
    const dq_t q = turned_about(d3(0.6, 0.8, 0.0), 0.3);
    const body_start_t start = {.pos_w_m = {0.1, 0.2, 1.0}, .q_wb = q, .held = true};
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, vehicle6_kinds[k], 0.002, &start))) continue;
    vehicle6_fly(&b, 1.5, 500);
    CHECK(b.y[RIGID_POS_M + 2] == 1.0 && b.y[RIGID_VEL_MPS + 2] == 0.0);
    CHECK_NEAR(b.y[RIGID_THRUST_N], 1.5 * WEIGHT_N / 4.0, 1e-6);
    CHECK_NEAR(d3_norm(d3_sub(body_specific_force_b_mps2(&b), dq_to_body(q, d3(0.0, 0.0, 9.81)))), 0.0, 1e-6);
    body_hold(&b, false);
    vehicle6_fly(&b, 1.5, 50);
    CHECK(b.y[RIGID_VEL_MPS + 2] > 0.3 && b.y[RIGID_VEL_MPS] > 0.2);
    body_hold(&b, true);
    const double z_m = b.y[RIGID_POS_M + 2];
    vehicle6_fly(&b, 1.5, 50);
    CHECK(b.y[RIGID_POS_M + 2] == z_m && b.y[RIGID_VEL_MPS] == 0.0);
    body_close(&b);
  }
}
