// test_watch_shows.c - what the guard is shown of a call, and what is learned of the height.
#include "rig/test.h"
#include "rig/watched.h"

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
