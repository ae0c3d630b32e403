// test_outer.c - the whole outer loop: it takes over, settles and learns.
#include "rig/rig3.h"
#include "rig/test.h"

#include <string.h>

// A vehicle that already does what the set point asks for, so that nothing is to be changed.
static const struct {
  const char *what;
  v3_t vel, up, acc; // acc: with `up` the one that follows from thrust 1.02 m g
} STEADY[] = {
    {"hover", {0, 0, 0}, {0, 0, 1}, {0, 0, 0.1962f}},
    {"climb at 0.5 m/s", {0, 0, 0.5f}, {0, 0, 1}, {0, 0, 0.1962f}},
    {"climb at 2 m/s", {0, 0, 2.0f}, {0, 0, 1}, {0, 0, 0.1962f}},
    {"tilted forward", {1, 0, 0}, {0.2f, 0, 0.9797959f}, {2.00124f, 0, -0.00597f}},
    {"tilted to the left", {0, 0.5f, 0}, {0, 0.2f, 0.9797959f}, {0, 2.00124f, -0.00597f}},
};

TEST(outer_takes_over_without_a_bump) {
  for (unsigned i = 0; i < sizeof STEADY / sizeof *STEADY; i++)
    for (int yaw = 0; yaw < 3; yaw++) {
      ROW("%s, yaw %d", STEADY[i].what, yaw);
      flight_param_t p = rig3_param();
      p.bias.pole_radps = 0.0f; // velocity and acceleration are of an instant here, not of a flight
      outer_t f = rig3_outer(&p);
      const double up[3] = {(double)STEADY[i].up.x, (double)STEADY[i].up.y, (double)STEADY[i].up.z};
      const float thrust_N = 1.02f * 0.032f * GRAVITY_MPS2;
      outer_in_t in = {.vel_w_mps = STEADY[i].vel,
                       .acc_b_mps2 = {0, 0, thrust_N / 0.032f},
                       .q_wb = rig3_attitude(up, (double)yaw),
                       .thrust_N = thrust_N};
      in.setpoint = (pos_setpoint_t){.vel_w_mps = in.vel_w_mps, .acc_w_mps2 = STEADY[i].acc};
      for (int k = 0; k < 50; k++) {
        in.pos_w_m = in.setpoint.pos_w_m = v3_scale((float)k * RIG3_PERIOD_S, in.vel_w_mps);
        const outer_out_t out = rig3_step(&f, &p, &in);
        CHECK_NEAR(out.thrust_N, thrust_N, 2e-6);
        CHECK_NEAR(out.up_w.x, STEADY[i].up.x, 1e-5);
        CHECK_NEAR(out.up_w.y, STEADY[i].up.y, 1e-5);
      }
      CHECK(rig3_faults(&f) == 0); // nothing was wrong
    }
}

// The same flight twice: with the bias taken off by somebody else all along, and from some tick on by the
// observer.
TEST(outer_takes_a_bias_over_without_a_bump) {
  static const struct {
    const char *what;
    float pole_radps, more_mps2, taken_mps2;
    double bump_N; // rounding; at its bound the observer does not follow the noise
  } row[] = {
      {"within the bound", 1.0f, 0.3f, 0.3f, 1e-6},
      {"downwards", 1.0f, -0.3f, -0.3f, 1e-6},
      {"beyond the bound", 1.0f, 0.9f, 0.5f, 3e-5},
      {"none is looked for", 0.0f, 0.3f, 0.0f, 1e-6},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flight_param_t p = rig3_param();
    p.bias.pole_radps = row[i].pole_radps;
    outer_t f = rig3_outer(&p), twin = rig3_outer(&p);
    CHECK(outer_take_bias(&f, row[i].more_mps2) == 0.0f); // before the first step
    outer_in_t in = {.acc_b_mps2 = {0, 0, GRAVITY_MPS2}, .q_wb = {.w = 1.0f}, .thrust_N = 0.32f};
    float taken_mps2 = 0.0f;
    double bump_N = 0.0;
    for (int k = 0; k < 400; k++) {
      in.acc_b_mps2.z = GRAVITY_MPS2 + 0.1f * (float)(k % 7 - 3);
      const outer_out_t alone = rig3_step(&twin, &p, &in);
      if (k == 100) taken_mps2 = outer_take_bias(&f, row[i].more_mps2);
      in.acc_b_mps2.z += taken_mps2;
      bump_N = fmax(bump_N, fabs((double)(rig3_step(&f, &p, &in).thrust_N - alone.thrust_N)));
    }
    CHECK_NEAR(taken_mps2, row[i].taken_mps2, 1e-3);
    CHECK_NEAR(f.bias.bias_mps2.z - twin.bias.bias_mps2.z, taken_mps2, 1e-3);
    CHECK_NEAR(bump_N, 0.0, row[i].bump_N);
  }
}

TEST(outer_takes_no_bias_into_a_state_that_is_none_and_none_that_is_no_number) {
  static const struct {
    float held_mps2, more_mps2;
  } row[] = {{NAN, 0.1f}, {1e10f, 0.1f}, {0.0f, NAN}, {0.0f, INFINITY}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    flight_param_t p = rig3_param();
    outer_t f = rig3_outer(&p);
    const outer_in_t in = {.acc_b_mps2 = {0, 0, GRAVITY_MPS2}, .q_wb = {.w = 1.0f}, .thrust_N = 0.32f};
    for (int k = 0; k < 10; k++) (void)rig3_step(&f, &p, &in);
    f.bias.bias_mps2.z = row[i].held_mps2;
    CHECK(outer_take_bias(&f, row[i].more_mps2) == 0.0f);
    CHECK_NEAR(rig3_step(&f, &p, &in).thrust_N, 0.32, 0.01);
    CHECK_NEAR(f.bias.bias_mps2.z, 0.0, 1e-3);
  }
}

TEST(outer_settles_at_the_set_point_in_all_three_axes) {
  static const struct {
    double x, y, z, yaw;
  } row[] = {{0.3, -0.2, 0.5, 0.0}, {-0.4, 0.3, 0.9, 2.0}, {0.0, 0.5, 0.7, -1.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    const flight_param_t p = rig3_param();
    outer_t f = rig3_outer(&p);
    rig3_t v = rig3_at(row[i].x, row[i].y, row[i].z, RIG3_NO_CEILING);
    v.yaw = row[i].yaw;
    const outer_out_t out = rig3_fly(&f, &p, &v, (v3_t){0.1f, 0.1f, 0.7f}, 1200);
    CHECK_NEAR(v.pos[0], 0.1, 1e-3);
    CHECK_NEAR(v.pos[1], 0.1, 1e-3);
    CHECK_NEAR(v.pos[2], 0.7, 1e-3);
    CHECK_NEAR(out.thrust_N, 0.032 * 9.81, 1e-4);
  }
}

TEST(outer_learns_the_curve_where_it_flew) {
  static const double gap_m[] = {0.10, 0.08, 0.06, 0.04, 0.03};
  flight_param_t p = rig3_param();
  p.curve.mode = CURVE_LIVE;
  p.curve.fixed = (rbf_weights_t){{1, 0, 0, 0, 0, 0, 0}};
  p.learn.far_m = 0.5f;
  outer_t f = rig3_outer(&p);
  rig3_t v = rig3_at(0, 0, 0.80, 1.0);
  for (int i = 0; i < 5; i++) rig3_fly(&f, &p, &v, (v3_t){0, 0, (float)(1.0 - gap_m[i])}, 1000);
  CHECK(f.learn.rls.count > 4500);
  for (int i = 0; i < 5; i++) {
    ROW("%g m", gap_m[i]);
    CHECK_NEAR(rbf_at(&f.learn.rls.theta, (float)gap_m[i]).ratio, rig3_ratio(gap_m[i]), 2e-3);
  }
}

TEST(outer_learns_the_thrust_along_its_axis_not_the_lift) {
  // 12 degrees of tilt take 2 % of the lift and nothing of the thrust.
  static const double up[] = {0.1470157, 0.1470157, 0.9781476};
  flight_param_t p = rig3_param();
  p.curve.mode = CURVE_LIVE;
  p.learn_after_s = 0.0f;
  p.bias.pole_radps = 0.0f;
  p.curve.fixed = (rbf_weights_t){{1, 0, 0, 0, 0, 0, 0}};
  outer_t f = rig3_outer(&p);
  const float thrust_N = 0.3f;
  for (int k = 0; k < 500; k++) {
    const outer_in_t in = {.acc_b_mps2 = {0, 0, 1.05f * thrust_N / p.pos.mass_kg},
                           .q_wb = rig3_attitude(up, 1.0),
                           .thrust_N = thrust_N,
                           .range_new = k % 10 == 0,
                           .range_m = 0.06f / (float)up[2]};
    (void)rig3_step(&f, &p, &in);
  }
  CHECK(f.learn.rls.count == 500);
  CHECK_NEAR(rbf_at(&f.learn.rls.theta, 0.06f).ratio, 1.05, 1e-3);
}

TEST(outer_learns_only_in_the_mode_that_learns) {
  for (int32_t mode = CURVE_OFF; mode <= CURVE_THEORY; mode++) {
    ROW("mode %d", (int)mode);
    flight_param_t p = rig3_param();
    p.curve.mode = mode;
    outer_t f = rig3_outer(&p);
    rig3_t v = rig3_at(0, 0, 0.94, 1.0);
    rig3_fly(&f, &p, &v, (v3_t){0, 0, 0.95f}, 300);
    const bool same = memcmp(&f.learn.rls.theta, &p.curve.fixed, sizeof p.curve.fixed) == 0;
    CHECK(same == (mode != CURVE_LIVE));
    CHECK((f.learn.rls.count == 0) == (mode != CURVE_LIVE));
  }
}

TEST(outer_teaches_nothing_after_a_saturated_command) {
  flight_param_t p;
  rig3_t v;
  outer_t f = rig3_in_flight(&p, &v);
  flight_param_t weak = p;
  weak.pos.thrust_max_N = 0.2f;
  outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
  const outer_out_t out = rig3_step(&f, &weak, &in);
  CHECK(out.thrust_N == weak.pos.thrust_max_N);
  const unsigned count = f.learn.rls.count;
  for (int k = 1; k < 50; k++) {
    ROW("tick %d", k);
    in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
    (void)rig3_step(&f, &p, &in);
    if (k <= 19) CHECK(f.learn.rls.count == count);
  }
  CHECK(f.learn.rls.count > count);
}
