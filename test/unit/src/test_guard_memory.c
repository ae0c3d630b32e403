// test_guard_memory.c - what the guard remembers and for how long: hover thrust, bad samples, reasons that
// end a flight, a landing.
#include "flight/judge.h"
#include "rig/hovering.h"
#include "rig/test.h"

static guard_in_t at_rest(void) {
  guard_in_t in = hovering(&HOVERING_FREE, 0);
  in.range_new = false;
  in.bias_known_mps2 = 0.0f;
  in.acc_b_mps2 = (v3_t){0.0f, 0.0f, 9.81f};
  in.rate_b_radps = (v3_t){0.0f, 0.0f, 0.0f};
  return in;
}

static void step(guard_t *g, guard_in_t in, int calls) {
  const guard_param_t p = hovering_param();
  for (; calls > 0; calls--) guard_step(g, &p, &in);
}

static guard_t begun(void) {
  guard_t g;
  guard_init(&g);
  step(&g, at_rest(), 1);
  return g;
}

// --- hover thrust -----------------------------------------------------------------------------------------

TEST(guard_learns_hover_thrust_as_a_mean_over_half_a_second) {
  static const struct {
    const char *what;
    float before_N, thrust_N;
    int ms;
    bool carries;
    double want_N;
  } row[] = {
      {"more", 0.30f, 0.40f, 1, true, 0.3002},
      {"less", 0.30f, 0.20f, 1, true, 0.2998},
      {"after missed calls", 0.30f, 0.40f, 10, true, 0.302},
      {"hardly any: 0.3 of the weight", 0.30f, 0.05f, 1, true, 0.3 - 0.002 * (0.3 - 0.099)},
      {"more than there is", 0.30f, 2.0f, 1, true, 0.3 + 0.002 * (0.6 - 0.3)},
      {"nothing known: the weight", 0.0f, 0.33f, 1, true, 0.33},
      {"less known than 0.3 of the weight", 0.098f, 0.33f, 1, true, 0.33},
      {"as much known", 0.3f * 0.33f, 0.33f, 1, true, 0.33},
      {"a little more known", 0.1f, 0.33f, 1, true, 0.10046},
      {"it does not carry", 0.30f, 0.40f, 1, false, 0.3},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    guard_t g = begun();
    guard_in_t in = at_rest();
    g.hover_N = row[i].before_N;
    in.thrust_N = row[i].thrust_N;
    in.carries = row[i].carries;
    in.ms = row[i].ms;
    step(&g, in, 1);
    CHECK_NEAR(g.hover_N, row[i].want_N, 1e-6);
  }
  guard_t g = begun();
  guard_in_t in = at_rest();
  in.setpoint_good = false; // something is wrong
  g.hover_N = 0.3f;
  step(&g, in, 5);
  CHECK(g.hover_N == 0.3f);
}

// --- bad samples ------------------------------------------------------------------------------------------

TEST(guard_counts_a_bad_sample_four_times_a_good_one_and_150_at_most) {
  guard_t g = begun();
  guard_in_t bad = at_rest();
  bad.acc_b_mps2.x = NAN;
  step(&g, bad, 10);
  CHECK_NEAR(g.bad_ms, 10.0, 1e-4);
  step(&g, at_rest(), 8);
  CHECK_NEAR(g.bad_ms, 8.0, 1e-4);
  guard_in_t late = at_rest();
  late.ms = 4;
  step(&g, late, 1);
  CHECK_NEAR(g.bad_ms, 7.0, 1e-4);
  step(&g, late, 10);
  CHECK(g.bad_ms == 0.0f);
  bad.ms = 4;
  step(&g, bad, 3);
  CHECK_NEAR(g.bad_ms, 12.0, 1e-4);
  step(&g, bad, 100);
  CHECK(g.bad_ms == 150.0f);
}

TEST(guard_keeps_a_reason_while_samples_are_bad) {
  guard_t g = begun();
  guard_in_t in = at_rest();
  in.acc_b_mps2.x = 300.0f;
  step(&g, in, 1);
  CHECK(g.now == GUARD_ACC_CLIPPED && g.acc_lost);
  in.acc_b_mps2.x = NAN;
  step(&g, in, 1);
  CHECK(g.now == (GUARD_ACC_CLIPPED | GUARD_NOT_A_NUMBER));
}

TEST(guard_lets_a_set_point_that_is_good_again_be_good_while_samples_are_bad) {
  guard_t g = begun();
  guard_in_t in = at_rest();
  in.setpoint_good = false;
  step(&g, in, 1);
  CHECK(g.now == GUARD_SETPOINT);
  in.rate_b_radps.x = NAN;
  step(&g, in, 1);
  CHECK(g.now == (GUARD_SETPOINT | GUARD_NOT_A_NUMBER));
  in.setpoint_good = true;
  step(&g, in, 1);
  CHECK(g.now == GUARD_NOT_A_NUMBER);
}

TEST(guard_does_without_an_accelerometer_that_was_clipped_for_200_ms) {
  guard_t g = begun();
  guard_in_t in = at_rest();
  in.acc_b_mps2.x = 300.0f;
  step(&g, in, 1);
  step(&g, at_rest(), 1);
  g.acc_life = 0.0f; // a perfect one, that never was alive
  step(&g, at_rest(), 198);
  CHECK(g.acc_lost);
  step(&g, at_rest(), 1);
  CHECK(!g.acc_lost);
}

// --- what ends a flight -----------------------------------------------------------------------------------

TEST(guard_hands_over_after_two_seconds_of_a_velocity_that_is_none) {
  guard_t g = begun();
  for (int ms = 1; ms <= 2001; ms++) {
    guard_in_t in = at_rest();
    in.vel_w_mps.x = ms % 2 ? 3.0f : -3.0f;
    step(&g, in, 1);
    if (ms == 1 || ms == 2000) CHECK(g.action == GUARD_RETREAT && g.vel_odd_ms == ms);
  }
  CHECK(g.action == GUARD_HAND_OVER && g.handed_ms == 1);
}

TEST(guard_has_landed_when_a_floor_carries_for_a_tenth_of_a_second) {
  static const struct {
    int floor_ms;
    bool carries, airborne;
  } row[] = {{99, false, true}, {100, false, false}, {500, true, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d ms", row[i].floor_ms);
    guard_t g = begun();
    CHECK(g.airborne);
    guard_in_t in = at_rest();
    in.on_floor = true;
    in.carries = row[i].carries;
    step(&g, in, row[i].floor_ms);
    CHECK(g.airborne == row[i].airborne && g.flown);
    in.on_floor = false; // a bump is forgotten
    step(&g, in, 1);
    in.on_floor = true;
    step(&g, in, 99);
    CHECK(g.airborne == row[i].airborne);
  }
}

TEST(guard_takes_more_than_a_centimetre_for_another_height) {
  static const struct {
    float other_m;
    guard_action_t want;
  } row[] = {{0.0095f, GUARD_RETREAT},
             {0.0105f, GUARD_FLY},
             {-0.0095f, GUARD_RETREAT},
             {-0.0105f, GUARD_FLY},
             {NAN, GUARD_RETREAT}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m", (double)row[i].other_m);
    guard_t g = begun();
    g.action = GUARD_RETREAT;
    g.asked_at_m = 1.7f;
    guard_in_t in = at_rest();
    in.asked_z_m = 1.7f;
    step(&g, in, 1001);
    CHECK(g.action == GUARD_RETREAT && g.retreat_ms == 1001);
    in.asked_z_m = 1.7f + row[i].other_m;
    step(&g, in, 1);
    CHECK(g.action == row[i].want);
  }
}

TEST(guard_begins_a_retreat_where_it_is_and_at_its_first_millisecond) {
  guard_t g = begun();
  g.retreat_ms = 77; // of an earlier one
  guard_in_t in = at_rest();
  in.pos_w_m = (v3_t){0.3f, -0.4f, 1.5f};
  in.asked_z_m = 1.6f;
  in.zc_m = 0.03f;
  in.blind_s = 100.0f;
  step(&g, in, 1);
  CHECK(g.action == GUARD_RETREAT && g.retreat_ms == 0 && g.asked_at_m == 1.6f);
  CHECK(g.hold_w_m.x == 0.3f && g.hold_w_m.y == -0.4f && g.hold_w_m.z == 1.5f && g.hold_z_m == 1.5f);
  in.pos_w_m = (v3_t){0.0f, 0.0f, 1.4f};
  step(&g, in, 1);
  CHECK(g.retreat_ms == 1 && g.hold_z_m == 1.5f);
}

// --- what is handed on ------------------------------------------------------------------------------------

TEST(guard_at_rest_keeps_what_was_latched_and_the_last_range) {
  guard_t g = begun();
  g.latched = GUARD_TILT;
  g.range_last_m = 0.4f;
  g.retreat_ms = 9;
  g.flown = true;
  g.action = GUARD_HAND_OVER;
  guard_rest(&g);
  CHECK(g.latched == GUARD_TILT && g.range_last_m == 0.4f);
  CHECK(g.retreat_ms == 0 && !g.flown && g.action == GUARD_FLY && !g.started);
}

TEST(guard_gives_a_bias_when_it_has_settled_for_two_seconds) {
  const guard_t young = {.bias_mps2 = 0.4f, .bias_s = 1.999f}, settled = {.bias_mps2 = 0.4f, .bias_s = 2.0f};
  CHECK(guard_settled_bias_mps2(&young) == 0.0f && guard_settled_bias_mps2(&settled) == 0.4f);
  guard_t g = {.bias_mps2 = 0.4f, .acc_bias_mps2 = 0.3f};
  guard_give_bias(&g, 0.1f);
  CHECK_NEAR(g.bias_mps2, 0.3, 1e-6);
  CHECK_NEAR(g.acc_bias_mps2, 0.2, 1e-6);
}

TEST(guard_takes_a_bias_off_where_one_is_looked_for_or_where_it_is_a_fault) {
  static const struct {
    float bias_mps2;
    bool looked_for, fault;
    float want_mps2;
  } row[] = {{0.3f, true, false, 0.3f}, {0.3f, false, false, 0.0f}, {0.8f, false, true, 0.8f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    guard_t g = begun();
    g.bias_mps2 = row[i].bias_mps2;
    g.now = row[i].fault ? GUARD_ACC_BIAS : 0u;
    guard_in_t in = at_rest();
    in.acc_b_mps2.z += row[i].bias_mps2;
    in.find_bias = row[i].looked_for;
    step(&g, in, 1);
    CHECK(g.acc_bias_mps2 == row[i].want_mps2);
  }
}
