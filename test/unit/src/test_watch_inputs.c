// test_watch_inputs.c - what the guard is shown of a call, and what the loops are given in its place.
#include "flight/bounds.h"
#include "flight/watch.h"
#include "rig/test.h"

#define HOVER_N (0.032f * GRAVITY_MPS2)

// In the air at 1 m, with sensors that are perfect, under no ceiling.
static flight_t hovering(flight_in_t *in) {
  flight_param_t p;
  params_default(&p);
  flight_t f;
  CHECK_OK(flight_init(&f, &p));
  f.outer.param.pos.mass_kg = 0.032f;
  f.outer.carrying_s = 5.0f;
  f.outer.out.ceiling_z_m = NAN;
  *in = (flight_in_t){
      .acc_b_mps2 = {.z = GRAVITY_MPS2},
      .pos_w_m = {.z = 1.0f},
      .q_wb = {.w = 1.0f},
      .setpoint = {.x = AXIS_POSITION, .y = AXIS_POSITION, .z = AXIS_POSITION, .pos_w_m = {.z = 1.0f}}};
  for (int i = 0; i < MOTORS; i++) in->force_N[i] = 0.25f * HOVER_N;
  return f;
}

// A call, so many milliseconds after the one before.
static flight_in_t watch(flight_t *f, const flight_in_t *in, int ms) {
  flight_in_t flown = *in;
  flown.step = f->step_last + (uint32_t)ms;
  watch_inputs(f, &flown);
  return flown;
}

// --- what the guard sees ----------------------------------------------------------------------------------

TEST(watch_shows_the_guard_what_carries_and_what_weighs) {
  flight_in_t in;
  flight_t f = hovering(&in);
  f.outer.sample.force_N = 0.36f;
  f.outer.sample.thrust_N = 0.3f;
  f.due = FLIGHT_OUTER; // a call that costs enough already
  (void)watch(&f, &in, 1);
  CHECK(f.guard.force_ms == 1);
  f.due = FLIGHT_LEARN;
  (void)watch(&f, &in, 1);
  CHECK_NEAR(f.guard.ratio_usual, 1.2, 1e-6);
  CHECK(f.guard.airborne && f.guard.full_ms == 0);
  f.outer.sample.thrust_N = 0.01f;
  f.outer.sample.weight_N = HOVER_N;
  f.outer.carrying_s = 0.0f;
  (void)watch(&f, &in, 1);
  CHECK_NEAR(f.guard.ratio_usual, 0.36 / (0.3 * (double)HOVER_N), 1e-5);
  CHECK(f.guard.floor_ms == 1 && f.guard.carried_s == 0.0f);
  for (int i = 0; i < MOTORS; i++) in.force_N[i] = 0.2475f * f.outer.param.pos.thrust_max_N;
  (void)watch(&f, &in, 1);
  CHECK(f.guard.full_ms == 1);
}

TEST(watch_shows_the_guard_the_range_and_the_ceiling) {
  static const struct {
    const char *what;
    float range_m, zc_m, blind_s;
    bool known;
    unsigned want;
    bool near_seen;
  } row[] = {
      {"as it should", 0.3f, 0.3f, 0.0f, true, 0, false},
      {"another distance", 0.3f, 0.2f, 0.0f, true, GUARD_RANGE_ODD, false},
      {"another, and no ceiling known", 0.3f, 0.2f, 0.0f, false, 0, false},
      {"at the sensor's floor", 0.044f, 0.12f, 0.0f, true, 0, true},
      {"near", 0.06f, 0.06f, 5.0f, true, 0, true},
      {"nearer than it sees", 0.06f, 0.049f, 5.0f, true, GUARD_BLIND, false},
      {"no distance", 0.0f, 0.3f, 0.0f, false, GUARD_RANGE_ODD, false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flight_in_t in;
    flight_t f = hovering(&in);
    f.outer.param.ceiling.floor_m = 0.045f;
    f.outer.param.ceiling.near_m = 0.05f;
    f.outer.ceiling.zc_m = row[i].zc_m;
    f.outer.ceiling.known = row[i].known;
    f.outer.ceiling.blind_s = row[i].blind_s;
    in.range_new = true;
    in.range_m = row[i].range_m;
    (void)watch(&f, &in, 1);
    CHECK(f.guard.now == row[i].want && f.guard.near_seen == row[i].near_seen);
    CHECK(f.guard.range_last_m == row[i].range_m);
  }
}

TEST(watch_shows_the_guard_the_height_that_is_wanted_as_far_as_the_ceiling_allows) {
  static const struct {
    const char *what;
    axis_mode_t z;
    float wanted_m;
    int nearer;
  } row[] = {{"far below", AXIS_POSITION, 1.0f, 2},
             {"beyond the ceiling: 8 cm below it", AXIS_POSITION, 2.5f, 2},
             {"a velocity", AXIS_VELOCITY, 1.0f, 0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (int gap_mm = 60; gap_mm <= 80; gap_mm += 20) {
      ROW("%s, %d mm", row[i].what, gap_mm);
      flight_in_t in;
      flight_t f = hovering(&in);
      f.outer.out.ceiling_z_m = 2.0f;
      f.outer.param.gap_min_m = 0.001f * (float)gap_mm;
      in.setpoint.z = row[i].z;
      in.setpoint.pos_w_m.z = row[i].wanted_m;
      in.range_new = true;
      in.range_m = 0.05f; // not as near as the guard allows at 60 mm
      (void)watch(&f, &in, 1);
      const bool allowed = row[i].wanted_m > 2.0f && gap_mm == 60;
      CHECK_NEAR(f.guard.nearer, allowed ? 0 : row[i].nearer, 0);
    }
}

TEST(watch_tells_the_guard_which_height_the_pilot_asked_for) {
  for (int by_velocity = 0; by_velocity < 2; by_velocity++) {
    flight_in_t in;
    flight_t f = hovering(&in);
    f.outer.out.ceiling_z_m = 2.0f;
    f.outer.ceiling = (ceiling_t){.known = true, .zc_m = 0.03f, .blind_s = 9.0f};
    in.setpoint.pos_w_m.z = 2.5f;
    if (by_velocity) in.setpoint.z = AXIS_VELOCITY;
    (void)watch(&f, &in, 1);
    CHECK(f.guard.action == GUARD_RETREAT);
    CHECK(by_velocity ? isnan(f.guard.asked_at_m) : f.guard.asked_at_m == 2.5f);
  }
}

// --- height -----------------------------------------------------------------------------------------------

TEST(watch_takes_a_jump_of_the_height_out_that_its_velocity_does_not_explain) {
  static const struct {
    float climb_mps;
    int ms;
    float dz_m;
    bool jump;
  } row[] = {
      {0.0f, 1, 0.0099f, false},  {0.0f, 1, 0.0101f, true},   {0.0f, 50, -0.0099f, false},
      {0.0f, 1, -0.0101f, true},  {1.0f, 1, 0.0208f, false},  {1.0f, 1, 0.0212f, true},
      {-1.0f, 1, 0.0208f, false}, {-1.0f, 1, -0.0212f, true}, {2.0f, 40, 0.1095f, false},
      {2.0f, 40, 0.1105f, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m at %g m/s in %d ms", (double)row[i].dz_m, (double)row[i].climb_mps, row[i].ms);
    flight_in_t in;
    flight_t f = hovering(&in);
    in.vel_w_mps.z = row[i].climb_mps;
    (void)watch(&f, &in, 1);
    CHECK(f.height_off_m == 0.0f && f.guard.latched == 0); // the first height is no jump
    in.pos_w_m.z += row[i].dz_m;
    const flight_in_t flown = watch(&f, &in, row[i].ms);
    CHECK(((f.guard.latched & GUARD_HEIGHT_JUMP) != 0) == row[i].jump);
    CHECK_NEAR(f.height_off_m, row[i].jump ? row[i].dz_m : 0.0f, 1e-6);
    CHECK_NEAR(flown.pos_w_m.z, row[i].jump ? 1.0f : 1.0f + row[i].dz_m, 1e-6);
    in.pos_w_m.z += row[i].dz_m;
    (void)watch(&f, &in, row[i].ms);
    CHECK_NEAR(f.height_off_m, row[i].jump ? 2.0f * row[i].dz_m : 0.0f, 1e-6);
  }
}

TEST(watch_shows_the_guard_how_far_the_height_has_jumped) {
  for (int side = -1; side <= 1; side += 2) {
    ROW("side %d", side);
    flight_in_t in;
    flight_t f = hovering(&in);
    (void)watch(&f, &in, 1);
    in.pos_w_m.z += 0.99f * (float)side;
    (void)watch(&f, &in, 1);
    CHECK(f.guard.off_ms == 0);
    in.pos_w_m.z += 0.02f * (float)side;
    (void)watch(&f, &in, 3);
    CHECK(f.guard.off_ms == 3);
  }
}

TEST(watch_takes_a_centimetre_for_no_jump) {
  flight_in_t in;
  flight_t f = hovering(&in);
  in.pos_w_m.z = 0.0f;
  (void)watch(&f, &in, 1);
  in.pos_w_m.z = BOUND_HEIGHT_JUMP_M;
  (void)watch(&f, &in, 1);
  CHECK(f.height_off_m == 0.0f);
}

TEST(watch_learns_no_height_from_an_estimate_that_is_out_of_its_bounds) {
  static const struct {
    float z_m, climb_mps;
    bool taken;
  } row[] = {{BOUND_POS_M, 0.0f, true},   {1.0001e4f, 0.0f, false}, {-BOUND_POS_M, 0.0f, true},
             {2.0f, BOUND_VEL_MPS, true}, {2.0f, -20.001f, false},  {NAN, 0.0f, false},
             {2.0f, NAN, false},          {-1.0001e4f, 0.0f, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m, %g m/s", (double)row[i].z_m, (double)row[i].climb_mps);
    flight_in_t in;
    flight_t f = hovering(&in);
    in.pos_w_m.z = row[i].z_m;
    in.vel_w_mps.z = row[i].climb_mps;
    (void)watch(&f, &in, 1);
    CHECK(f.height_seen == row[i].taken);
    CHECK(f.height_m == (row[i].taken ? row[i].z_m : 0.0f));
  }
}

TEST(watch_keeps_the_sum_of_jumps_within_twice_the_largest_position) {
  for (int side = -1; side <= 1; side += 2) {
    flight_in_t in;
    flight_t f = hovering(&in);
    (void)watch(&f, &in, 1);
    f.height_off_m = (float)side * 19500.0f;
    in.pos_w_m.z += (float)side * 400.0f;
    (void)watch(&f, &in, 1);
    CHECK_NEAR(f.height_off_m, side * 19900.0, 0.01);
    in.pos_w_m.z += (float)side * 400.0f;
    (void)watch(&f, &in, 1);
    CHECK(f.height_off_m == (float)side * 20000.0f);
  }
}

TEST(watch_forgets_jumps_and_reasons_of_now_where_the_height_is_let_go) {
  flight_in_t in;
  flight_t f = hovering(&in);
  in.range_new = true;
  in.range_m = 0.5f;
  (void)watch(&f, &in, 1);
  in.pos_w_m.z += 1.0f;
  (void)watch(&f, &in, 1);
  in.range_new = false;
  in.setpoint.z = AXIS_OFF;
  const flight_in_t flown = watch(&f, &in, 1);
  CHECK(f.height_off_m == 0.0f && flown.pos_w_m.z == 2.0f);
  CHECK(f.guard.latched == GUARD_HEIGHT_JUMP && f.guard.range_last_m == 0.5f);
  CHECK(!f.guard.airborne && f.guard.action == GUARD_FLY);
}

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
