// test_judge_ceiling.c - the range sensor, and the thrust near a ceiling, call by call.
#include "flight/judge.h"
#include "rig/hovering.h"
#include "rig/test.h"

static guard_in_t under(float zc_m) {
  const hover_t h = {zc_m, zc_m, zc_m, 1.0f};
  guard_in_t in = hovering(&h, 1);
  in.range_new = false;
  return in;
}

static void judge(guard_t *g, guard_in_t in, int calls) {
  const guard_param_t p = hovering_param();
  for (; calls > 0; calls--) g->now = judge_ceiling(g, &p, &in);
}

static guard_t begun(void) {
  guard_t g;
  guard_init(&g);
  g.bias_s = JUDGE_SETTLED_S;
  return g;
}

// --- range ------------------------------------------------------------------------------------------------

static void sample(guard_t *g, float zc_m, float range_m, float z_m) {
  guard_in_t in = under(zc_m);
  in.range_new = true;
  in.range_m = range_m;
  in.pos_w_m.z = z_m;
  judge(g, in, 1);
}

TEST(guard_takes_a_range_for_frozen_that_is_the_same_for_long_enough_and_often_enough) {
  static const struct {
    const char *what;
    int apart_ms, samples; // after the first one
    float moved_m;
    bool frozen;
  } row[] = {
      {"three in 201 ms", 67, 3, 0.03f, true}, {"three in 198 ms", 66, 3, 0.03f, false},
      {"four in 200 ms", 50, 4, 0.03f, true},  {"two in 300 ms", 150, 2, 0.03f, false},
      {"199 in 199 ms", 1, 199, 0.03f, false}, {"200 in 200 ms", 1, 200, 0.03f, true},
      {"in a hover", 100, 10, 0.0199f, false}, {"in a descent", 100, 3, -0.0201f, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    guard_t g = begun();
    sample(&g, 0.1f, 0.1f, 1.0f);
    CHECK(g.range_z_m == 1.0f && g.range_last_m == 0.1f && g.range_new_ms == 0);
    for (int k = 0; k < row[i].samples; k++) {
      judge(&g, under(0.1f), row[i].apart_ms - 1);
      CHECK(g.range_new_ms == row[i].apart_ms - 1);
      sample(&g, 0.1f, 0.1f, 1.0f + row[i].moved_m);
      CHECK_NEAR(g.range_same_ms, row[i].apart_ms * (k + 1), 0);
    }
    CHECK(((g.now & GUARD_RANGE_FROZEN) != 0) == row[i].frozen);
    judge(&g, under(0.1f), 1);
    CHECK(((g.now & GUARD_RANGE_FROZEN) != 0) == row[i].frozen); // until the next sample
    sample(&g, 0.1f, 0.101f, 1.0f);
    CHECK((g.now & GUARD_RANGE_FROZEN) == 0 && g.range_same == 0 && g.range_same_ms == 0);
  }
}

TEST(guard_keeps_an_odd_range_in_mind_until_the_next_sample) {
  guard_t g = begun();
  sample(&g, 0.3f, 0.4f, 1.0f);
  CHECK(g.now == GUARD_RANGE_ODD);
  judge(&g, under(0.3f), 50);
  CHECK(g.now == GUARD_RANGE_ODD);
  sample(&g, 0.3f, 0.3f, 1.0f);
  CHECK(g.now == 0);
  sample(&g, 0.0f, 0.05f, 1.0f); // by 5 cm, and no more
  CHECK(g.now == 0);
}

TEST(guard_knows_a_ceiling_that_was_near_from_the_range_that_it_can_see) {
  static const struct {
    float zc_m;
    bool known, near;
  } row[] = {{0.1999f, true, true},  {0.2f, true, false}, {0.05f, true, true},
             {0.0499f, true, false}, {0.3f, false, true}, {0.04f, false, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m, known %d", (double)row[i].zc_m, row[i].known);
    guard_t g = begun();
    g.near_seen = !row[i].known;
    guard_in_t in = under(row[i].zc_m);
    in.zc_known = row[i].known;
    judge(&g, in, 250);
    CHECK(g.near_seen == row[i].near && (g.now & GUARD_RANGE_LOST) == 0);
    judge(&g, in, 1);
    CHECK(((g.now & GUARD_RANGE_LOST) != 0) == row[i].near);
    in.range_new = true;
    in.range_m = 4.1f; // no distance: it stays lost
    judge(&g, in, 1);
    CHECK(((g.now & GUARD_RANGE_LOST) != 0) == row[i].near);
    in.range_m = 4.0f;
    judge(&g, in, 1);
    CHECK((g.now & GUARD_RANGE_LOST) == 0);
  }
}

// --- thrust -----------------------------------------------------------------------------------------------

TEST(guard_lets_the_usual_ratio_follow_by_the_time_that_has_passed) {
  static const struct {
    float ratio;
    int ms;
    double want;
  } row[] = {{1.1f, 1, 1.0 + 0.1 * 0.01 * 0.001 / 5.0}, // the mean of now has gone a hundredth of the way
             {1.1f, 10, 1.0 + 0.1 * 0.1 * 0.01 / 5.0},
             {0.9f, 1, 1.0 - 0.1 * 0.01 * 0.001 / 2.0},
             {0.9f, 50, 1.0 - 0.1 * 0.5 * 0.05 / 2.0},
             {0.9f, 100, 1.0 - 0.1 * 0.1 / 2.0},
             {0.9f, 5000, 0.9}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g for %d ms", (double)row[i].ratio, row[i].ms);
    guard_t g = begun();
    judge(&g, under(0.3f), 1100);
    CHECK(g.ratio_usual == 1.0f);
    CHECK_NEAR(g.carried_s, 1.1, 1e-3);
    guard_in_t in = under(0.3f);
    in.force_N = 0.33f * row[i].ratio;
    in.ms = row[i].ms;
    judge(&g, in, 1);
    CHECK_NEAR(g.ratio_usual, row[i].want, 2e-7);
  }
}

TEST(guard_takes_the_mean_ratio_of_a_tenth_of_a_second) {
  // A ratio of 1.5 brings the mean to 1.15 after 36 ms; it has to stay there for 10.
  static const struct {
    int ms;
    bool raised;
  } row[] = {{44, false}, {45, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d ms", row[i].ms);
    guard_t g = begun();
    judge(&g, under(0.3f), 1500);
    guard_in_t in = under(0.3f);
    in.force_N = 0.33f * 1.5f;
    judge(&g, in, row[i].ms);
    CHECK(((g.now & GUARD_RATIO) != 0) == row[i].raised);
  }
}

TEST(guard_judges_the_ratio_once_for_each_sample_of_it) {
  guard_t g = begun();
  judge(&g, under(0.3f), 1500);
  guard_in_t fresh = under(0.3f), stale = under(0.3f);
  fresh.force_N = stale.force_N = 0.33f * 1.5f;
  stale.force_new = false;
  for (int sample = 1; sample <= 4; sample++) { // to 1.15 and beyond, as one mean over 40 ms
    judge(&g, stale, 9);
    CHECK((g.now & GUARD_RATIO) == 0 && g.force_ms == 9);
    judge(&g, fresh, 1);
    CHECK(((g.now & GUARD_RATIO) != 0) == (sample == 4) && g.force_ms == 0);
  }
  judge(&g, stale, 500); // until the next one
  CHECK((g.now & GUARD_RATIO) != 0);
  judge(&g, under(0.3f), 1); // half a second later all that was is forgotten
  CHECK((g.now & GUARD_RATIO) == 0 && g.ratio_now == 1.0f);
}

TEST(guard_has_no_usual_ratio_in_the_first_second_in_the_air) {
  guard_t g = begun();
  judge(&g, under(0.3f), 500);
  guard_in_t in = under(0.3f);
  in.force_N = 0.33f * 1.5f;
  judge(&g, in, 20);
  CHECK(g.ratio_usual == 1.5f && g.ratio_ms == 0 && g.now == 0);
  judge(&g, in, 20000);
  CHECK_NEAR(g.carried_s, 10.0, 1e-3); // and no longer
}

TEST(guard_has_no_usual_ratio_where_a_bit_of_it_flipped) {
  static const struct {
    float usual, now, want;
  } row[] = {{4.99f, 1.0f, 4.99f - 3.99f * 0.001f / 2.0f}, // as large as that it is believed
             {5.01f, 1.0f, 1.0f},
             {1.0f, 5.1f, 1.0f},
             {0.31f, 1.0f, 0.31f + 0.69f * 0.001f / 5.0f},
             {0.29f, 1.0f, 1.0f},
             {1.0f, 0.29f, 1.0f},
             {-1.0f, 1.0f, 1.0f},
             {NAN, 1.0f, 1.0f},
             {1.0f, NAN, 1.0f},
             {INFINITY, 1.0f, 1.0f},
             {2e38f, 2e38f, 1.0f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("usual %g, now %g", (double)row[i].usual, (double)row[i].now);
    guard_t g = begun();
    judge(&g, under(0.3f), 1500);
    g.ratio_usual = row[i].usual;
    g.ratio_now = row[i].now;
    judge(&g, under(0.3f), 1);
    CHECK_NEAR(g.ratio_usual, row[i].want, 1e-5);
    CHECK(g.now == 0);
  }
}

TEST(guard_finds_nothing_carried_too_much_where_nothing_is_carried) {
  static const float force_N[] = {0.0f, -0.1f};
  for (unsigned i = 0; i < sizeof force_N / sizeof *force_N; i++) {
    ROW("%g N", (double)force_N[i]);
    guard_t g = begun();
    guard_in_t in = under(0.3f);
    in.force_N = force_N[i];
    judge(&g, in, 900);
    CHECK(g.now == 0 && g.ratio_ms == 0);
  }
  guard_t g = begun();
  guard_in_t in = under(0.3f);
  in.force_N = 0.0f;
  judge(&g, in, 1500);
  CHECK(g.now == 0 && g.ratio_usual == 0.0f);
}

TEST(guard_counts_no_sample_that_is_as_near_as_is_allowed) {
  guard_t g = begun();
  guard_in_t in = under(0.3f);
  in.range_new = true;
  in.range_m = 0.05f;
  in.pos_w_m.z = in.setpoint_z_m = 0.0f;
  in.ceiling_z_m = in.range_m + 0.015f;
  judge(&g, in, 1);
  CHECK(g.nearer == 0);
  in.setpoint_z_m = -0.01f;
  judge(&g, in, 1);
  CHECK(g.nearer == 1); // the height knows it, to the bit
}

TEST(guard_takes_the_sum_of_what_is_too_near_as_it_stands) {
  static const struct { int before, after; } row[] = {{0, 0}, {1, 1}, {20, 20}, {21, 0}, {-1, 0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d", row[i].before);
    guard_t g = begun();
    g.nearer = row[i].before;
    judge(&g, under(0.3f), 1);
    CHECK_NEAR(g.nearer, row[i].after, 0);
  }
}
