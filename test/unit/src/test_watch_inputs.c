// test_watch_inputs.c - what the loops are given in the place of a call's inputs.
#include "rig/test.h"
#include "rig/watched.h"

// --- what flies -------------------------------------------------------------------------------------------

TEST(watch_flies_the_last_good_set_point_where_one_is_none) {
  flight_in_t in;
  flight_t f = hovering(&in);
  in.setpoint.pos_w_m.x = 0.5f;
  (void)watch(&f, &in, 1);
  in.setpoint.pos_w_m.x = NAN;
  const flight_in_t flown = watch(&f, &in, 1);
  CHECK(flown.setpoint.pos_w_m.x == 0.5f && f.setpoint.pos_w_m.x == 0.5f);
  CHECK(f.guard.now == GUARD_SETPOINT && f.guard.action == GUARD_HOLD);
}

TEST(watch_goes_down_in_a_retreat_where_it_is_and_turns_as_before) {
  flight_in_t in;
  flight_t f = hovering(&in);
  f.guard.action = GUARD_RETREAT;
  f.guard.hold_w_m = (v3_t){0.3f, -0.2f, 1.0f};
  f.guard.hold_z_m = 1.0f;
  f.guard.retreat_ms = 500;
  f.guard.asked_at_m = 1.0f;
  f.guard.airborne = true;
  in.setpoint =
      (flight_setpoint_t){.x = AXIS_VELOCITY, .y = AXIS_OFF, .z = AXIS_POSITION, .pos_w_m = {9, 9, 1}};
  in.setpoint.vel_mps = in.setpoint.acc_w_mps2 = (v3_t){1.0f, 2.0f, 3.0f};
  in.setpoint.yaw_rad = 0.7f;
  const flight_setpoint_t sp = watch(&f, &in, 1).setpoint;
  CHECK(sp.x == AXIS_POSITION && sp.y == AXIS_POSITION && sp.z == AXIS_POSITION && sp.yaw_rad == 0.7f);
  CHECK(sp.pos_w_m.x == 0.3f && sp.pos_w_m.y == -0.2f);
  CHECK_NEAR(sp.pos_w_m.z, 1.0f - f.outer.param.guard.sink_mps / f.outer.param.pos.kp_z_per_s, 1e-6);
  CHECK(sp.vel_mps.x == 0.0f && sp.vel_mps.y == 0.0f && sp.vel_mps.z == 0.0f);
  CHECK(sp.acc_w_mps2.x == 0.0f && sp.acc_w_mps2.y == 0.0f && sp.acc_w_mps2.z == 0.0f);
}

TEST(watch_hands_over_level_below_hover_thrust) {
  flight_in_t in;
  flight_t f = hovering(&in);
  f.guard.action = GUARD_HAND_OVER;
  f.guard.hover_N = 0.3f;
  f.guard.airborne = true;
  in.setpoint.roll_rad = 0.3f;
  const flight_setpoint_t sp = watch(&f, &in, 1).setpoint;
  CHECK(sp.x == AXIS_OFF && sp.y == AXIS_OFF && sp.z == AXIS_OFF && sp.yaw == YAW_RATE);
  CHECK(sp.roll_rad == 0.0f && sp.yaw_rate_radps == 0.0f);
  CHECK_NEAR(sp.thrust_N, f.outer.param.guard.share * f.guard.hover_N, 1e-6);
}

TEST(watch_puts_the_model_in_the_place_of_an_accelerometer_that_is_lost) {
  static const struct {
    int clip_ms;
    float hover_N, bias_mps2;
    v3_t want;
  } row[] = {
      {100, 0.3f, 0.0f, {0.0f, 0.0f, 1.1f * GRAVITY_MPS2}},
      {100, 0.0f, 0.0f, {1.0f, 2.0f, 3.0f}}, // nothing is known yet that carries
      {0, 0.3f, 0.0f, {1.0f, 2.0f, 3.0f}},
      {0, 0.3f, 0.4f, {1.0f, 2.0f - 0.2f, 3.0f - 0.3464102f}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    flight_in_t in;
    flight_t f = hovering(&in);
    in.q_wb = (quat_t){.w = 0.9659258f, .x = 0.2588190f}; // 30 degrees about x
    in.acc_b_mps2 = (v3_t){1.0f, 2.0f, 3.0f};
    f.guard.acc_clip_ms = row[i].clip_ms;
    f.guard.hover_N = row[i].hover_N, f.outer.carrying_s = 0.0f; // learns no hover thrust
    f.outer.sync.thrust.model_N = 0.33f;
    f.guard.started = true;
    f.guard.bias_mps2 = row[i].bias_mps2;
    f.guard.acc_last = in.acc_b_mps2;
    const v3_t got = watch(&f, &in, 1).acc_b_mps2;
    CHECK_NEAR(got.x, row[i].want.x, 1e-5);
    CHECK_NEAR(got.y, row[i].want.y, 1e-5);
    CHECK_NEAR(got.z, row[i].want.z, 1e-5);
  }
}

TEST(watch_takes_a_bias_off_where_one_is_looked_for) {
  for (int looked_for = 0; looked_for < 2; looked_for++) {
    flight_in_t in;
    flight_t f = hovering(&in);
    f.outer.param.bias.pole_radps = (float)looked_for;
    f.guard.started = true;
    f.guard.bias_mps2 = 0.2f;
    (void)watch(&f, &in, 1);
    CHECK(f.guard.acc_bias_mps2 == (looked_for ? 0.2f : 0.0f));
  }
}

TEST(watch_hands_a_settled_bias_over_to_the_outer_loop) {
  static const struct {
    float bias_mps2, since_s;
    bool settled;
  } row[] = {{0.2f, 1.99f, false}, {0.2f, 2.0f, true}, {1.0f, 2.0f, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    flight_in_t in;
    flight_t f = hovering(&in);
    f.outer.started = true;
    f.guard.started = true;
    f.guard.bias_mps2 = row[i].bias_mps2;
    f.guard.bias_s = row[i].since_s;
    (void)watch(&f, &in, 1);
    const float taken_mps2 = f.outer.bias.bias_mps2.z;
    CHECK((taken_mps2 > 0.0f) == row[i].settled);
    CHECK_NEAR(f.guard.bias_mps2, row[i].bias_mps2 - taken_mps2, 1e-6);
    CHECK_NEAR(f.guard.acc_bias_mps2, row[i].bias_mps2 - taken_mps2, 1e-6);
  }
}

TEST(watch_looks_for_a_bias_beside_the_one_that_the_outer_loop_knows) {
  flight_in_t in;
  flight_t f = hovering(&in);
  f.outer.bias.bias_mps2.z = 0.2f;
  in.acc_b_mps2.z += 0.25f;
  for (int ms = 0; ms < 10; ms++) (void)watch(&f, &in, 1);
  CHECK_NEAR(f.guard.bias_fast_mps2, 0.05 / 15.0, 1e-4);
}

TEST(watch_flies_the_last_velocity_where_one_is_lost) {
  flight_in_t in;
  flight_t f = hovering(&in);
  in.vel_w_mps.x = 0.1f;
  (void)watch(&f, &in, 1);
  in.vel_w_mps.x = 3.0f;
  const flight_in_t flown = watch(&f, &in, 1);
  CHECK(f.guard.vel_lost && flown.vel_w_mps.x == 0.1f);
}

TEST(watch_takes_a_range_of_less_than_a_centimetre_for_none) {
  flight_in_t in;
  flight_t f = hovering(&in);
  in.range_m = 0.0099f;
  CHECK(watch(&f, &in, 1).range_m == 0.0f);
  in.range_m = CEILING_RANGE_MIN_M;
  CHECK(watch(&f, &in, 1).range_m == CEILING_RANGE_MIN_M);
}

// --- by hand ----------------------------------------------------------------------------------------------

TEST(watch_makes_a_climb_of_a_thrust_by_hand_under_a_ceiling) {
  flight_in_t in;
  flight_t f = hovering(&in);
  in.setpoint = (flight_setpoint_t){.thrust_N = 1.5f * HOVER_N, .acc_w_mps2 = {1.0f, 2.0f, 3.0f}};
  in.vel_w_mps.z = 1.0f;
  f.by_hand = (by_hand_t){.gap_m = 0.5f, .since_s = 0.1f, .held = true};
  const flight_in_t flown = watch(&f, &in, 7);
  CHECK_NEAR(f.by_hand.gap_m, 0.493, 1e-6);
  CHECK_NEAR(f.by_hand.since_s, 0.107, 1e-6);
  (void)watch(&f, &in, 1);
  CHECK_NEAR(f.by_hand.gap_m, 0.492, 1e-6);
  (void)watch(&f, &in, 50);
  CHECK_NEAR(f.by_hand.gap_m, 0.442, 1e-6);
  CHECK(flown.setpoint.z == AXIS_VELOCITY && flown.setpoint.acc_w_mps2.z == 0.0f);
  CHECK(flown.setpoint.acc_w_mps2.y == 2.0f && flown.setpoint.vel_mps.z > 0.0f);
  f.by_hand.since_s = BY_HAND_BELIEVE_S;
  CHECK(watch(&f, &in, 1).setpoint.z == AXIS_OFF);
}

TEST(watch_forgets_a_ceiling_by_hand_where_the_height_is_controlled) {
  flight_in_t in;
  flight_t f = hovering(&in);
  f.by_hand = (by_hand_t){.gap_m = 0.1f, .since_s = 0.0f, .held = true};
  (void)watch(&f, &in, 1);
  CHECK(!f.by_hand.held && f.by_hand.since_s == BY_HAND_BELIEVE_S);
}
