// test_body_vertical.c - the body on the vertical axis alone, a point: contact and release, and a push from
// outside.
#include "rig/vehicle6.h"

static model_t point_with(const char *effect, double ceiling_m) {
  model_t m = vehicle6(ceiling_m);
  if (effect) vehicle6_add(&m, effect);
  return model_point(&m);
}

static bool open_at(body_t *b, const model_t *m, integrate_kind_t kind, double z_m, double climb_mps,
                    double share) {
  body_start_t start = vehicle6_start(m, z_m, share);
  start.vel_w_mps.z = climb_mps;
  start.vertical_only = true;
  return CHECK_OK(body_open(b, m, kind, 0.002, &start));
}

TEST(thrust_follows_its_command_with_the_lag_of_the_motors) {
  const model_t m = point_with(NULL, HUGE_VAL);
  body_t b;
  if (!open_at(&b, &m, INTEGRATE_SUNDIALS, 1.0, 0.0, 0.0)) return;
  vehicle6_fly(&b, 0.9, 72); // 16 rad/s reach 90 % after 0.144 s, not 0.3 s
  CHECK_NEAR(b.y[RIGID_THRUST_N], 0.9 * 0.9 * WEIGHT_N / ROTORS, 1e-4);
  body_close(&b);
}

TEST(body_on_the_vertical_axis_hits_the_ceiling_sticks_and_lets_go) {
  // At full suction (+44 %) a vehicle at the ceiling stays there with any thrust above weight / 1.44.
  static const struct {
    double hold_share; // of the weight
    bool stays;
  } row[] = {{1.2, true}, {0.80, true}, {0.70, true}, {0.68, false}, {0.0, false}};
  for (unsigned i = 0; i < 2 * sizeof row / sizeof *row; i++) {
    const double share = row[i / 2].hold_share;
    ROW("%g of the weight, kind %u", share, i % 2);
    const model_t m = point_with("ceiling", 0.5);
    body_t b;
    if (!open_at(&b, &m, vehicle6_kinds[i % 2], 0.45, 0.0, 1.0)) continue;
    vehicle6_fly(&b, 1.3, 1000);
    CHECK(b.ceiling_contacts >= 1 && b.on_ceiling); // its blades are stiff: it may bounce by a millimetre
    CHECK_NEAR(b.y[RIGID_POS_M + 2], 0.5, 1e-5);
    CHECK_NEAR(body_specific_force_b_mps2(&b).z, 9.81, 1e-6);
    vehicle6_fly(&b, share, 300);
    CHECK(b.on_ceiling == row[i / 2].stays);
    body_close(&b);
  }
}

TEST(body_on_the_vertical_axis_never_tunnels_whatever_speed_it_hits_with) {
  for (int speed = 1; speed <= 64; speed *= 2) {
    ROW("%d m/s", speed);
    const model_t m = point_with("ceiling", 0.5);
    body_t b;
    if (!open_at(&b, &m, INTEGRATE_RK4, 0.2, speed, 0.0)) continue;
    for (int half = 0; half < 12; half++) {
      vehicle6_fly(&b, half % 2 ? 0.0 : 1.8, 125);
      CHECK(b.y[RIGID_POS_M + 2] > -1e-4 && b.y[RIGID_POS_M + 2] < 0.5001);
    }
    CHECK(b.ceiling_contacts >= 1 && !b.broken);
    body_close(&b);
  }
}

TEST(body_between_a_floor_and_a_ceiling_that_touch_comes_to_an_end) {
  static const double ceiling_m[] = {0.0, 1e-8, 1e-7, 2e-7};
  for (unsigned i = 0; i < sizeof ceiling_m / sizeof *ceiling_m; i++) {
    ROW("%g m", ceiling_m[i]);
    const model_t m = point_with("ceiling", ceiling_m[i]);
    body_t b;
    if (!open_at(&b, &m, INTEGRATE_SUNDIALS, 0.0, 0.0, 1.0)) continue;
    for (int half = 0; half < 10; half++) vehicle6_fly(&b, half % 2 ? 1.8 : 0.0, 50);
    CHECK_NEAR(b.y[RIGID_POS_M + 2], 0.0, 1e-5);
    body_close(&b);
  }
}

TEST(body_is_pushed_by_what_pushes_it_from_outside) {
  const model_t m = point_with(NULL, HUGE_VAL);
  for (int k = 0; k < 2; k++) {
    ROW("kind %d", k);
    body_t b;
    if (!open_at(&b, &m, vehicle6_kinds[k], 1.0, 0.0, 1.0)) continue;
    body_push(&b, d3(0.0, 0.0, 0.2 * MASS_KG));
    vehicle6_fly(&b, 1.0, 100);
    body_push(&b, d3(0.0, 0.0, -0.2 * MASS_KG));
    vehicle6_fly(&b, 1.0, 100);
    CHECK_NEAR(b.y[RIGID_VEL_MPS + 2], 0.0, 1e-9);
    CHECK_NEAR(b.y[RIGID_POS_M + 2], 1.0 + 0.2 * 0.2 * 0.2, 1e-9);
    body_close(&b);
  }
}
