// test_judge_motion.c - the accelerometer's bias, the velocity and frozen sensors, call by call.
#include "flight/judge.h"
#include "rig/test.h"

// At rest in the air, with sensors that are perfect.
static guard_in_t resting(void) {
  return (guard_in_t){.ms = 1, .q_wb = {.w = 1.0f}, .acc_b_mps2 = {.z = GRAVITY_MPS2}, .find_bias = true};
}

static guard_t begun(void) {
  guard_t g;
  guard_init(&g);
  const guard_in_t in = resting();
  judge_begin(&g, &in);
  return g;
}

static void judge(guard_t *g, guard_in_t in, int calls) {
  for (; calls > 0; calls--) g->now = judge_motion(g, &in);
}

// --- bias -------------------------------------------------------------------------------------------------

TEST(guard_finds_a_step_of_the_accelerometers_bias_as_the_mean_since_then) {
  static const struct {
    float error_mps2, known_mps2;
    int ms;
    double bias_mps2, since_s;
  } row[] = {
      // By hand: the mean over 0.15 s, every 10 ms, passes 0.3 m/s2 in the sixth period.
      {1.0f, 0.0f, 59, 0.0, 2.0},
      {1.0f, 0.0f, 60, 0.40564, 0.16},
      {1.0f, 0.0f, 69, 0.40564, 0.16},
      {1.0f, 0.0f, 70, 0.44279, 0.17},
      {-1.0f, 0.0f, 80, -0.47556, 0.18},
      {1.2f, 0.2f, 100, 0.53077, 0.2},
      {1.0f, 0.0f, 500, 0.8489, 0.6},
      {1.0f, 0.0f, 960, 0.91085, 1.06}, // from a second on what is left is the outer loop's
      {1.0f, 0.0f, 5000, 0.91085, 2.0},
      {0.35f, 0.0f, 280, 0.0, 2.0},
      {0.35f, 0.0f, 300, 0.3275, 0.17},
      {100.0f, 0.0f, 20, 0.58667, 0.16}, // no more than 3 m/s2 is believed
      {-100.0f, 0.0f, 40, -1.18933, 0.16},
      {100.0f, 0.0f, 5000, 2.91553, 2.0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m/s2 for %d ms", (double)row[i].error_mps2, row[i].ms);
    guard_t g = begun();
    guard_in_t in = resting();
    in.acc_b_mps2.z += row[i].error_mps2;
    in.bias_known_mps2 = row[i].known_mps2;
    judge(&g, in, row[i].ms);
    CHECK_NEAR(g.bias_mps2, row[i].bias_mps2, 5e-4);
    CHECK_NEAR(g.bias_s, row[i].since_s, 0.011);
    const bool settled = row[i].since_s >= 2.0;
    CHECK_NEAR(guard_settled_bias_mps2(&g), settled ? row[i].bias_mps2 : 0.0, 5e-4);
  }
}

TEST(guard_takes_a_bias_for_a_step_from_0_3_on) {
  for (int side = -1; side <= 1; side += 2) {
    ROW("side %d", side);
    guard_t g = begun();
    guard_in_t in = resting();
    in.acc_b_mps2.z += 0.298f * (float)side;
    judge(&g, in, 3000);
    CHECK(g.bias_mps2 == 0.0f && g.bias_s >= 2.0f);
    CHECK_NEAR(g.bias_fast_mps2, 0.298 * side, 1e-3);
    in.acc_b_mps2.z = GRAVITY_MPS2 + 0.302f * (float)side;
    judge(&g, in, 3000);
    CHECK_NEAR(g.bias_mps2, 0.3035 * side, 3e-3);
  }
}

TEST(guard_holds_a_settled_bias_against_its_bounds) {
  static const struct {
    float bias_mps2;
    bool before, after;
  } row[] = {{0.499f, false, false},  {0.5f, false, false},   {0.25f, true, false},  {0.501f, false, true},
             {-0.499f, false, false}, {-0.501f, false, true}, {0.249f, true, false}, {0.251f, true, true},
             {-0.251f, true, true},   {-0.249f, true, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m/s2 after %d", (double)row[i].bias_mps2, row[i].before);
    guard_t g = begun();
    guard_in_t in = resting();
    in.acc_b_mps2.z += row[i].bias_mps2;
    g.bias_mps2 = row[i].bias_mps2;
    g.now = row[i].before ? GUARD_ACC_BIAS : 0u;
    judge(&g, in, 9); // within the estimator's period as before
    CHECK(((g.now & GUARD_ACC_BIAS) != 0) == row[i].before);
    judge(&g, in, 1);
    CHECK(((g.now & GUARD_ACC_BIAS) != 0) == row[i].after);
    CHECK(g.bias_s == JUDGE_SETTLED_S && g.bias_mps2 == row[i].bias_mps2);
  }
}

TEST(guard_bounds_a_bias_that_is_none_and_forgets_one_that_is_no_number) {
  static const struct { float held_mps2, want_mps2; } row[] = {{4.0f, 3.0f}, {-1e10f, -3.0f}, {NAN, 0.0f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    guard_t g = begun();
    g.bias_mps2 = row[i].held_mps2;
    judge(&g, resting(), 10); // one period of the estimator
    CHECK(g.bias_mps2 == row[i].want_mps2);
  }
}

TEST(guard_finds_a_step_of_the_bias_after_a_bit_of_what_it_remembers_flipped) {
  static const struct {
    float fast_mps2, known_mps2;
    int window_ms;
  } row[] = {{0.0f, 0.0f, 0},  {12.1f, 0.0f, 0}, {-1e30f, 0.0f, 0}, {NAN, 0.0f, 0},
             {0.0f, 15.2f, 0}, {0.0f, 1e30f, 0}, {0.0f, NAN, 0},    {0.0f, 0.0f, INT32_MIN}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    guard_t g = begun();
    guard_in_t in = resting();
    g.bias_fast_mps2 = row[i].fast_mps2;
    g.window_ms = row[i].window_ms;
    in.bias_known_mps2 = row[i].known_mps2;
    judge(&g, in, 30);
    CHECK(g.bias_mps2 == 0.0f && g.bias_s >= JUDGE_SETTLED_S); // none is found for it
    in.bias_known_mps2 = 0.0f;
    in.acc_b_mps2.z += 1.0f;
    judge(&g, in, 1000);
    CHECK_NEAR(g.bias_mps2, 0.91, 0.01);
  }
}

TEST(guard_takes_a_long_pause_for_no_more_than_one_whole_sample_of_the_bias) {
  static const struct {
    float since_s;
    int ms;
    double share;
  } row[] = {{2.0f, 200, 0.0}, {0.1f, 200, 1.0}, {0.5f, 200, 0.4}, {1.0f, 200, 0.0}, {0.01f, 10, 1.0 / 15.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g s after a step", (double)row[i].since_s);
    guard_t g = begun();
    guard_in_t in = resting();
    in.acc_b_mps2.z += 0.2f;
    in.ms = row[i].ms;
    g.bias_s = row[i].since_s;
    judge(&g, in, 1);
    CHECK_NEAR(g.bias_fast_mps2, row[i].ms == 200 ? 0.2 : 0.2 / 15.0, 1e-5);
    CHECK_NEAR(g.bias_mps2, 0.2 * row[i].share, 1e-5);
  }
}

TEST(guard_sees_no_bias_in_what_the_velocity_explains) {
  static const struct {
    const char *what;
    quat_t q_wb;
    v3_t acc_w_mps2;
    int ms; // of a call
  } row[] = {
      {"up", {.w = 1.0f}, {0, 0, 2.0f}, 1},
      {"tilted, and along", {.w = 0.9659258f, .x = 0.2588190f}, {1.0f, -2.0f, -3.0f}, 1},
      {"upside down", {.y = 1.0f}, {0, 0, 1.0f}, 1},
      {"in calls of 3 ms", {.w = 1.0f}, {0, 0, 1.0f}, 3},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    guard_t g = begun();
    guard_in_t in = resting();
    in.q_wb = row[i].q_wb;
    in.ms = row[i].ms;
    const v3_t felt = {row[i].acc_w_mps2.x, row[i].acc_w_mps2.y, row[i].acc_w_mps2.z + GRAVITY_MPS2};
    in.acc_b_mps2 = quat_to_body(in.q_wb, felt);
    for (int ms = in.ms; ms <= 12; ms += in.ms) {
      in.vel_w_mps = v3_scale(0.001f * (float)ms, row[i].acc_w_mps2);
      judge(&g, in, 1);
    }
    CHECK_NEAR(g.bias_fast_mps2, 0.0, 1e-3);
    CHECK_NEAR(g.window_ms, row[i].ms == 3 ? 0 : 2, 0);
  }
  ROW("what it does not");
  guard_t g = begun();
  guard_in_t in = resting();
  in.ms = 3;
  in.acc_b_mps2.z += 0.2f;
  judge(&g, in, 3);
  CHECK(g.bias_fast_mps2 == 0.0f);
  judge(&g, in, 1);
  CHECK_NEAR(g.bias_fast_mps2, 0.12 * 0.2 / 1.5, 1e-5);
  CHECK(g.window_ms == 0 && g.window_mps == 0.0f);
}

TEST(guard_looks_for_no_bias_in_an_accelerometer_that_is_lost_or_was_clipped) {
  static const struct {
    int clip_ms;
    bool lost;
    int window_ms; // after one more call
  } row[] = {{0, false, 6}, {1, false, 6}, {2, false, 0}, {100, false, 0}, {0, true, 0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    guard_t g = begun();
    guard_in_t in = resting();
    in.acc_b_mps2.z += 0.2f;
    judge(&g, in, 5);
    g.acc_clip_ms = row[i].clip_ms;
    g.acc_lost = row[i].lost;
    g.now = GUARD_ACC_BIAS;
    in.vel_w_mps.z = 0.1f;
    judge(&g, in, 1);
    CHECK_NEAR(g.window_ms, row[i].window_ms, 0);
    CHECK(g.window_vel_mps == (row[i].window_ms > 0 ? 0.0f : 0.1f));
    CHECK((g.now & GUARD_ACC_BIAS) != 0); // what was found stays
  }
}

// --- velocity ---------------------------------------------------------------------------------------------

TEST(guard_believes_a_velocity_again_when_it_was_calm_for_50_ms) {
  static const v3_t jump[] = {{0.51f, 0, 0}, {0, -0.51f, 0}, {0, 0, 3.0f}};
  for (unsigned i = 0; i < sizeof jump / sizeof *jump; i++) {
    ROW("jump %u", i);
    guard_t g = begun();
    guard_in_t in = resting();
    in.vel_w_mps = jump[i];
    judge(&g, in, 50);
    CHECK(g.vel_lost && (g.now & GUARD_VELOCITY) != 0 && g.vel_odd_ms == 50);
    CHECK_NEAR(g.vel_w_mps.x, 0.0, 1e-6);
    judge(&g, in, 1);
    CHECK(!g.vel_lost && (g.now & GUARD_VELOCITY) == 0 && g.vel_odd_ms == 0);
    CHECK(g.vel_w_mps.x == jump[i].x && g.vel_w_mps.z == jump[i].z);
  }
}

TEST(guard_carries_a_lost_velocity_on_with_what_is_felt) {
  guard_t g = begun();
  g.acc_bias_mps2 = 0.5f;
  guard_in_t in = resting();
  in.vel_w_mps.x = 5.0f;
  in.acc_b_mps2.z += 2.5f;
  judge(&g, in, 10);
  CHECK(g.vel_lost && g.vel_w_mps.x == 0.0f);
  CHECK_NEAR(g.vel_w_mps.z, 0.02, 1e-6);
  in.ms = 20;
  judge(&g, in, 1);
  CHECK_NEAR(g.vel_w_mps.z, 0.06, 1e-6);
}

TEST(guard_carries_a_lost_velocity_on_without_the_bias_that_the_outer_loop_knows) {
  guard_t g = begun();
  guard_in_t in = resting();
  in.bias_known_mps2 = 0.4f;
  in.acc_b_mps2.z += 0.4f;
  in.vel_w_mps.x = 3.0f;
  for (int k = 0; k < 40; k++) {
    in.vel_w_mps.x = -in.vel_w_mps.x; // never calm
    judge(&g, in, 1);
  }
  CHECK(g.vel_lost);
  CHECK_NEAR(g.vel_w_mps.z, 0.0, 1e-4);
}

TEST(guard_takes_what_it_holds_and_what_the_outer_loop_knows_for_one_bias) {
  static const struct {
    float held_mps2, known_mps2;
    bool fault;
  } row[] = {{0.2f, 0.5f, true}, {0.0f, 0.499f, false}, {-0.2f, 0.5f, false}, {-0.2f, -0.5f, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    guard_t g = begun();
    guard_in_t in = resting();
    g.bias_mps2 = row[i].held_mps2;
    in.bias_known_mps2 = row[i].known_mps2;
    in.acc_b_mps2.z += row[i].held_mps2 + row[i].known_mps2;
    judge(&g, in, 10);
    CHECK(((g.now & GUARD_ACC_BIAS) != 0) == row[i].fault);
  }
}

TEST(guard_believes_a_velocity_that_jumps_within_300_ms_of_an_impact) {
  static const struct {
    float felt_mps2;
    int later_ms;
    bool lost;
  } row[] = {
      {24.9f, 1, true}, {25.1f, 1, false}, {-25.1f, 1, false}, {25.1f, 299, false}, {25.1f, 300, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m/s2, %d ms later", (double)row[i].felt_mps2, row[i].later_ms);
    guard_t g = begun();
    guard_in_t in = resting();
    in.acc_b_mps2.x = row[i].felt_mps2;
    judge(&g, in, 1);
    in.acc_b_mps2.x = 0.0f;
    judge(&g, in, row[i].later_ms - 1);
    in.vel_w_mps.y = 2.0f;
    judge(&g, in, 1);
    CHECK(g.vel_lost == row[i].lost);
    judge(&g, resting(), 400);
    CHECK(g.impact_ms == 0);
  }
}

TEST(guard_begins_with_the_first_sample_as_if_it_had_always_been_so) {
  guard_t g;
  guard_init(&g);
  guard_in_t in = resting();
  in.rate_b_radps = (v3_t){3.0f, -2.0f, 1.0f};
  in.acc_b_mps2.x = 4.0f;
  in.vel_w_mps = (v3_t){2.0f, 1.0f, -3.0f};
  judge_begin(&g, &in);
  judge(&g, in, 10);
  CHECK(g.now == 0 && g.rate_life == 0.0f && g.acc_life == 0.0f);
  CHECK(g.bias_fast_mps2 == 0.0f && g.bias_s >= 2.0f && g.vel_calm_ms == 10);
}

// --- sensors that stand still -----------------------------------------------------------------------------

TEST(guard_takes_a_sensor_for_frozen_that_was_alive) {
  static const struct {
    const char *what;
    float rate_life, acc_life; // before it stands still for 25 ms; then a fifth less
    unsigned want;
  } row[] = {
      {"gyro that was hardly alive", 6.3e-4f, 0.0f, 0},
      {"gyro that was", 6.43e-4f, 0.0f, GUARD_GYRO_FROZEN},
      {"accelerometer that was hardly alive", 0.0f, 2.52e-3f, 0},
      {"accelerometer that was", 0.0f, 2.57e-3f, GUARD_ACC_FROZEN},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    guard_t g = begun();
    g.rate_life = row[i].rate_life;
    g.acc_life = row[i].acc_life;
    judge(&g, resting(), 24);
    CHECK(g.now == 0);
    judge(&g, resting(), 1);
    CHECK(g.now == row[i].want);
    const float life[] = {g.rate_life, g.acc_life};
    CHECK_NEAR(life[0], 0.78568 * (double)row[i].rate_life, 1e-7); // 0.99 ^ 24
    judge(&g, resting(), 100);
    CHECK(g.now == row[i].want && g.rate_life == life[0] && g.acc_life == life[1]);
  }
  guard_t g = begun();
  g.rate_same_ms = 30;
  g.rate_life = 5e-4f;
  judge(&g, resting(), 1);
  CHECK(g.now == 0);
  g.rate_life = 5.001e-4f;
  judge(&g, resting(), 1);
  CHECK(g.now == GUARD_GYRO_FROZEN);
}

TEST(guard_measures_a_sensors_life_by_its_change_in_a_millisecond) {
  guard_t g = begun();
  guard_in_t in = resting();
  in.rate_b_radps = (v3_t){0.02f, -0.03f, 0.01f};
  in.acc_b_mps2.x = -0.4f;
  judge(&g, in, 1);
  CHECK_NEAR(g.rate_life, 6e-4, 1e-8);
  CHECK_NEAR(g.acc_life, 4e-3, 1e-7);
  in.acc_b_mps2.x = 100.0f; // a knock is not a hundred times the life
  judge(&g, in, 1);
  CHECK_NEAR(g.rate_life, 0.99 * 6e-4, 1e-8);
  CHECK_NEAR(g.acc_life, 0.99 * 4e-3 + 0.01, 1e-7);
}

TEST(guard_remembers_a_clipped_acceleration_for_200_ms) {
  guard_t g = begun();
  guard_in_t in = resting();
  in.acc_b_mps2.y = -196.3f;
  judge(&g, in, 1);
  CHECK(g.now == GUARD_ACC_CLIPPED && g.acc_clip_ms == 200);
  judge(&g, resting(), 199);
  CHECK((g.now & GUARD_ACC_CLIPPED) == 0 && g.acc_clip_ms == 1);
  in = resting();
  in.ms = 3;
  judge(&g, in, 1);
  CHECK(g.acc_clip_ms == 0);
  g.acc_clip_ms = 5;
  judge(&g, in, 1);
  CHECK(g.acc_clip_ms == 2);
}

TEST(guard_allows_a_lean_of_60_degrees_to_the_bit) {
  guard_t g = begun();
  guard_in_t in = resting();
  in.q_wb = (quat_t){.w = 0.866025388f, .x = 0.5f};
  CHECK(quat_up(quat_unit(in.q_wb)).z == 0.5f);
  judge(&g, in, 5);
  CHECK(g.now == 0 && g.tilt_ms == 0);
  in.q_wb.x = 0.5001f;
  judge(&g, in, 5);
  CHECK(g.now == GUARD_TILT && g.tilt_ms == 5);
}
