// test_outer_limits.c - the outer loop's limits: nearest gap, thrust step, when learning starts, what a rest
// forgets.
#include "rig/rig3.h"
#include "rig/test.h"

TEST(outer_goes_no_nearer_to_the_ceiling_than_ceil_min_whatever_is_asked_for) {
  static const struct {
    const char *what;
    bool hold_place; // a velocity is wanted, not a height
    float z_m, vel_mps, acc_mps2;
  } row[] = {
      {"height above the ceiling", false, 1.5f, 0, 0},   {"velocity upwards", true, 0, 0.3f, 0},
      {"fast velocity upwards", true, 0, 1.0f, 0},       {"height and velocity", false, 1.5f, 0.2f, 0},
      {"height below, velocity", false, 0.9f, 0.3f, 0},  {"height and acceleration", false, 0.93f, 0, 2.0f},
      {"velocity and acceleration", true, 0, 0.3f, 2.0f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flight_param_t p = rig3_param();
    p.curve.mode = CURVE_THEORY;
    p.gap_min_m = 0.05f;
    outer_t f = rig3_outer(&p);
    rig3_t v = rig3_at(0, 0, 0.6, 1.0);
    double highest_m = 0.0;
    for (int k = 0; k < 1500; k++) {
      const float z_m = row[i].hold_place ? (float)v.pos[2] : row[i].z_m;
      outer_in_t in = rig3_sense(&v, (v3_t){0, 0, z_m});
      in.setpoint.vel_w_mps.z = row[i].vel_mps;
      in.setpoint.acc_w_mps2.z = row[i].acc_mps2;
      const outer_out_t out = rig3_step(&f, &p, &in);
      rig3_move(&v, &out);
      highest_m = fmax(highest_m, v.pos[2]);
    }
    CHECK(highest_m < 0.953);
    CHECK_NEAR(v.pos[2], row[i].z_m > 1.0f ? 0.95 - (double)OUTER_CLIP_M : 0.95, 2e-3);
  }
}

TEST(outer_leaves_set_points_alone_that_do_not_come_too_near) {
  const flight_param_t p = rig3_param();
  outer_t f = rig3_outer(&p), free = rig3_outer(&p);
  rig3_t v = rig3_at(0, 0, 0.7, 1.0);
  rig3_fly(&f, &p, &v, (v3_t){0, 0, 0.7f}, 100);
  free = f;
  free.hold.ceiling_z_m = 100.0f;
  outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.75f});
  in.range_new = false;
  in.setpoint.vel_w_mps.z = 0.1f; // at 1/s there is room for 0.23 m/s at the set point
  in.setpoint.acc_w_mps2.z = 0.3f;
  const outer_out_t out = rig3_step(&f, &p, &in), want = rig3_step(&free, &p, &in);
  CHECK(out.thrust_N == want.thrust_N);
}

TEST(outer_flies_higher_once_the_ceiling_is_gone) {
  static const double other_m[] = {1.6, 3.5};
  for (unsigned i = 0; i < sizeof other_m / sizeof *other_m; i++) {
    ROW("a ceiling at %g m instead of one at 1 m", other_m[i]);
    const flight_param_t p = rig3_param();
    outer_t f = rig3_outer(&p);
    rig3_t v = rig3_at(0, 0, 0.6, 1.0);
    rig3_fly(&f, &p, &v, (v3_t){0, 0, 0.9f}, 600);
    rig3_fly(&f, &p, &v, (v3_t){0, 0, 1.4f}, 900);
    CHECK_NEAR(v.pos[2], 0.98 - (double)OUTER_CLIP_M, 2e-3);
    v.ceiling_m = other_m[i];
    rig3_fly(&f, &p, &v, (v3_t){0, 0, 1.4f}, 25);
    CHECK(v.pos[2] < 0.979); // not yet
    rig3_fly(&f, &p, &v, (v3_t){0, 0, 1.4f}, 1500);
    CHECK_NEAR(v.pos[2], 1.4, 2e-3);
  }
}

TEST(outer_knows_the_distance_from_the_propellers_not_from_the_sensor) {
  static const float offset_m[] = {0.02f, -0.03f};
  for (unsigned i = 0; i < sizeof offset_m / sizeof *offset_m; i++) {
    ROW("propellers %g m above the sensor", (double)offset_m[i]);
    flight_param_t p = rig3_param();
    p.up_offset_m = offset_m[i];
    outer_t f = rig3_outer(&p);
    const rig3_t v = rig3_at(0, 0, 0.6, 1.0);
    const outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.6f}); // the sensor is 0.4 m below the ceiling
    CHECK_NEAR(rig3_step(&f, &p, &in).zc_m, 0.4f - offset_m[i], 1e-6);
  }
}

TEST(outer_keeps_the_thrust_within_its_step_about_what_the_motors_give) {
  for (int up = 0; up < 2; up++) {
    ROW("%s", up ? "up" : "down");
    flight_param_t p = rig3_param();
    p.step_max_N = 0.012f;
    outer_t f = rig3_outer(&p);
    const rig3_t v = rig3_at(0, 0, 2.0, RIG3_NO_CEILING);
    const outer_in_t in = rig3_sense(&v, (v3_t){0, 0, up ? 5.0f : -1.0f});
    for (int k = 0; k < 3; k++)
      CHECK_NEAR(rig3_step(&f, &p, &in).thrust_N, in.thrust_N + (up ? 0.012f : -0.012f), 1e-6);
  }
}

TEST(outer_learns_only_a_while_after_the_rotors_began_to_carry) {
  static const float after_s[] = {0.0f, 0.5f, 1.0f};
  for (unsigned i = 0; i < sizeof after_s / sizeof *after_s; i++) {
    flight_param_t p = rig3_param();
    p.curve.mode = CURVE_LIVE;
    p.learn_after_s = after_s[i];
    p.learn.settle_s = 0.0f;
    outer_t f = rig3_outer(&p);
    rig3_t v = rig3_at(0, 0, 0.94, 1.0);
    int first = -1;
    for (int k = 0; k < 200; k++) {
      rig3_fly(&f, &p, &v, (v3_t){0, 0, 0.94f}, 1);
      if (first < 0 && f.learn.rls.count > 0) first = k;
    }
    ROW("after %g s", (double)after_s[i]);
    CHECK_NEAR(first, 100.0f * after_s[i], 1.01);
  }
}

TEST(outer_at_rest_forgets_the_ceiling) {
  flight_param_t p;
  rig3_t v;
  outer_t f = rig3_in_flight(&p, &v);
  outer_rest(&f);
  outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
  in.range_new = false;
  const outer_out_t out = rig3_step(&f, &p, &in);
  CHECK(!out.zc_known);
  CHECK(isnan(out.ceiling_z_m));
}

TEST(outer_keeps_bias_and_ceiling_through_a_reset_of_the_height) {
  flight_param_t p;
  rig3_t v;
  outer_t f = rig3_in_flight(&p, &v);
  const float before_m = f.out.ceiling_z_m, bias_mps2 = f.bias.bias_mps2.z;
  for (int k = 0; k < 20; k++) {
    outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 1.24f});
    in.pos_w_m.z += 0.3f;
    const outer_out_t out = rig3_step(&f, &p, &in);
    CHECK_NEAR(out.ceiling_z_m, before_m + 0.3f, 2e-3);
    CHECK_NEAR(f.bias.bias_mps2.z, bias_mps2, 2e-3);
    rig3_move(&v, &out);
  }
}

// By how much the thrust is raised below a ceiling at this gap, where a height beyond it is wanted, the
// rotors give the weight and the accelerometer feels `felt` of it.
static float raised_N(float gap_m, float felt, float climb_mps, int32_t law, float push_N) {
  flight_param_t p = rig3_param();
  p.pos.law = law;
  p.push_N = push_N;
  p.curve.mode = CURVE_OFF;
  p.gap_min_m = 0.0f;
  outer_t f;
  CHECK_OK(outer_init(&f, &p, 0.01f));
  rig3_t v = rig3_at(0, 0, 1.0 - (double)gap_m, RIG3_NO_CEILING);
  outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 1.05f});
  const float weight_N = p.pos.mass_kg * GRAVITY_MPS2;
  in.thrust_N = weight_N;
  in.acc_b_mps2 = (v3_t){0, 0, felt * GRAVITY_MPS2};
  in.range_new = false;
  (void)outer_step(&f, &in);
  f.ceiling.known = true;
  f.ceiling.zc_m = gap_m;
  in.vel_w_mps.z = climb_mps;
  in.pos_w_m.z += 0.01f * climb_mps;
  return outer_step(&f, &in)->thrust_N - weight_N;
}

TEST(outer_pushes_against_a_ceiling_no_harder_than_it_is_told) {
  static const struct {
    const char *what;
    float gap_m, felt, climb_mps;
    int32_t law;
    float push_N;
    bool raises;
  } row[] = {
      {"pushes as hard as it may", 0.008f, 0.8f, 0.0f, LAW_PREDICTED, 0.05f, false},
      {"may push harder", 0.008f, 0.8f, 0.0f, LAW_PREDICTED, 0.2f, true},
      {"flies", 0.008f, 1.0f, 0.0f, LAW_PREDICTED, 0.05f, true},
      {"cannot reach it", 0.016f, 0.8f, 0.0f, LAW_PREDICTED, 0.05f, true},
      {"sinks", 0.008f, 0.8f, -0.04f, LAW_PREDICTED, 0.05f, true},
      {"thesis's law", 0.008f, 0.8f, 0.0f, LAW_THESIS, 0.05f, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const float N = raised_N(row[i].gap_m, row[i].felt, row[i].climb_mps, row[i].law, row[i].push_N);
    CHECK((N > 1e-3f) == row[i].raises);
  }
}
