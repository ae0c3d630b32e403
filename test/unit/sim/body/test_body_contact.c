// test_body_contact.c - six degrees of freedom that touch the ceiling, the ground, at any speed and tilt.
#include "rig/turned.h"
#include "rig/vehicle6.h"

TEST(body_sticks_to_the_ceiling_as_long_as_the_suction_holds) {
  // Suction at the distance that the top keeps: 1 + 0.44 exp(-80 d).
  static const struct {
    double top_m, hold_share;
    bool stays;
  } row[] = {{0.005, 0.80, true},  {0.005, 0.76, false},  {0.008, 0.83, true}, {0.008, 0.79, false},
             {-0.005, 0.71, true}, {-0.005, 0.67, false}, {0.005, 1.20, true}, {0.005, 0.0, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (int k = 0; k < 2; k++) {
      ROW("top %g m, %g of the weight, kind %d", row[i].top_m, row[i].hold_share, k);
      model_t m = vehicle6(0.5);
      vehicle6_add(&m, "ceiling");
      m.frame.top_above_rotor_m = row[i].top_m;
      const body_start_t start = vehicle6_start(&m, 0.45, 1.0);
      body_t b;
      if (!CHECK_OK(body_open(&b, &m, vehicle6_kinds[k], 0.002, &start))) continue;
      vehicle6_fly(&b, 1.3, 1000);
      CHECK(b.on_ceiling && b.ceiling_contacts >= 1);
      CHECK_NEAR(b.y[RIGID_VEL_MPS + 2], 0.0, 1e-9);
      CHECK_NEAR(body_ceiling_gap_m(&b, 0), fmax(row[i].top_m, 0.0), 2e-5);
      const int before = b.ceiling_contacts;
      vehicle6_fly(&b, row[i].hold_share, 300);
      CHECK(b.on_ceiling == row[i].stays);
      CHECK((body_clearance(&b).ceiling_m < 1e-4) == row[i].stays);
      CHECK(b.ceiling_contacts == before && b.floor_contacts <= 1);
      body_close(&b);
    }
}

TEST(body_never_tunnels_whatever_speed_and_tilt_it_hits_with) {
  static const double speeds[] = {-10.0, -3.0, 0.5, 3.0, 10.0}, tilts[] = {0.0, 0.1, 0.6, 1.5, 3.0};
  for (int s = 0; s < 5; s++)
    for (int a = 0; a < 5; a++)
      for (int k = 0; k < 2; k++) {
        ROW("%g m/s, tilt %g, kind %d", speeds[s], tilts[a], k);
        model_t m = vehicle6(0.5);
        vehicle6_add(&m, "ceiling");
        m.frame.top_above_rotor_m = 0.008;
        body_start_t start = {.pos_w_m = {0.0, 0.0, 0.25}, .vel_w_mps = {1.0, 0.0, speeds[s]}};
        start.q_wb = turned_about(d3(0.6, 0.8, 0.0), tilts[a]);
        start.rate_b_radps = d3(3.0, -2.0, 1.0);
        body_t b;
        if (!CHECK_OK(body_open(&b, &m, vehicle6_kinds[k], 0.002, &start))) continue;
        double deepest_m = 0.0, fastest_mps = 0.0;
        for (int t = 0; t < 2000; t++) {
          vehicle6_fly(&b, t < 1000 && t % 100 < 50 ? 1.8 : 0.0, 1);
          const touch_gap_t gap = body_clearance(&b);
          deepest_m = fmin(deepest_m, fmin(gap.floor_m, gap.ceiling_m));
          if (t > 20) fastest_mps = fmax(fastest_mps, d3_norm(d3_of(b.y + RIGID_VEL_MPS)));
        }
        CHECK(deepest_m > (fabs(speeds[s]) > 5.0 ? -0.02 : -0.006)); // an edge is softer than four feet
        CHECK(fastest_mps < 1.2 * fabs(speeds[s]) + 4.0);            // nothing is gained by hitting
        CHECK(!b.broken && b.on_floor && b.floor_contacts >= 1);
        CHECK(d3_norm(d3_of(b.y + RIGID_VEL_MPS)) < 0.02); // lies still, however it lies
        body_close(&b);
      }
}

TEST(body_rests_on_the_ground_until_its_thrust_carries_it) {
  for (int k = 0; k < 2; k++) {
    ROW("kind %d", k);
    const model_t m = vehicle6(HUGE_VAL);
    const body_start_t start = {.pos_w_m = {0.0, 0.0, body_rest_z_m(&m)}};
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, vehicle6_kinds[k], 0.002, &start))) continue;
    vehicle6_fly(&b, 0.0, 1000);
    CHECK_NEAR(b.y[RIGID_POS_M + 2], body_rest_z_m(&m) - MASS_KG * 9.81 / 4.0 / (TOUCH_SPRING * MASS_KG),
               1e-9);
    CHECK_NEAR(d3_norm(d3_sub(body_specific_force_b_mps2(&b), d3(0.0, 0.0, 9.81))), 0.0, 1e-6);
    vehicle6_fly(&b, 0.95, 4000);
    CHECK_NEAR(d3_norm(d3_of(b.y + RIGID_VEL_MPS)), 0.0, 1e-9);
    CHECK_NEAR(hypot(b.y[0], b.y[1]), 0.0, 1e-9);
    CHECK(vehicle6_tilt_rad(&b) < 1e-7 && b.on_floor && b.floor_contacts == 0);
    vehicle6_fly(&b, 1.2, 150);
    CHECK(!b.on_floor && body_clearance(&b).floor_m > 0.01);
    CHECK(b.floor_contacts == 0 && b.ceiling_contacts == 0);
    vehicle6_fly(&b, 0.0, 1000);
    CHECK(b.on_floor && b.floor_contacts >= 1);
    CHECK_NEAR(d3_norm(d3_of(b.y + RIGID_VEL_MPS)), 0.0, 1e-6);
    body_close(&b);
  }
}

TEST(friction_stops_a_vehicle_that_slides_with_half_of_its_weight) {
  static const struct { double mps, m; } row[] = {{0.3, 0.00917}, {0.5, 0.02548}, {1.0, 0.10194}};
  for (int i = 0; i < 3; i++) {
    ROW("%g m/s", row[i].mps);
    const model_t m = vehicle6(HUGE_VAL);
    body_start_t start = {.pos_w_m = {0.0, 0.0, body_rest_z_m(&m) - 8e-6},
                          .vel_w_mps = {row[i].mps, 0.0, 0.0}};
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
    vehicle6_fly(&b, 0.0, 1000);
    // v^2 / (2 * 0.5 * 9.81 m/s2), and a little for the grip at the end
    CHECK_NEAR(b.y[RIGID_POS_M], row[i].m, 1e-3 + 0.02 * row[i].m);
    CHECK_NEAR(b.y[RIGID_VEL_MPS], 0.0, 1e-9);
    body_close(&b);
  }
}
