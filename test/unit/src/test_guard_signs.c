// test_guard_signs.c - what the guard follows, sums up and counts, and where one sign is not enough.
#include "flight/flight.h"
#include "rig/hovering.h"
#include "rig/test.h"

static void carries_more(guard_in_t *in, float x, int ms) {
  (void)ms, in->force_N = 0.33f * x;
}
static void thrust(guard_in_t *in, float x, int ms) {
  (void)ms, in->thrust_N = x;
}

TEST(guard_follows_what_the_thrust_usually_carries_slowly_up_and_quickly_down) {
  watched_t w = hovering_started(&HOVERING_FREE);
  CHECK_NEAR(w.g.ratio_usual, 1.0, 1e-6);
  hovering_fly(&w, &HOVERING_FREE, carries_more, 1.1f, 3000);
  CHECK_NEAR(w.g.ratio_usual, 1.1 - 0.1 * exp(-3.0 / 5.0) * 5.0 / 4.9, 1e-4); // behind the mean of now
  hovering_fly(&w, &HOVERING_FREE, carries_more, 0.9f, 1000); // until the mean of now is there
  const double before = (double)w.g.ratio_usual;
  hovering_fly(&w, &HOVERING_FREE, carries_more, 0.9f, 1000);
  CHECK_NEAR(w.g.ratio_usual, 0.9 + (before - 0.9) * exp(-1.0 / 2.0), 1e-4);
  CHECK(w.g.latched == 0);
}

TEST(guard_knows_what_is_usual_after_a_second_in_the_air) {
  const guard_param_t p = hovering_param();
  guard_t g;
  guard_init(&g);
  for (int ms = 1; ms <= 1100; ms++) {
    guard_in_t in = hovering(&HOVERING_FREE, ms);
    in.force_N = 0.33f * (1.0f + 0.001f * (float)ms);
    guard_step(&g, &p, &in);
    if (ms < 999) CHECK_NEAR(g.ratio_usual, 1.0 + 0.001 * ms, 1e-5); // as it comes
    if (ms == 1100) CHECK_NEAR(g.ratio_usual, 2.0, 5e-3);            // held
  }
  guard_in_t in = hovering(&HOVERING_FREE, 1101); // no thrust: what is felt is no ratio of it
  in.carries = false;
  in.thrust_now_N = 0.01f;
  guard_step(&g, &p, &in);
  CHECK_NEAR(g.ratio_usual, 1.0 / 0.3, 1e-5);
  CHECK(g.carried_s == 0.0f);
}

static void carries_more_unknown(guard_in_t *in, float x, int ms) {
  (void)ms, in->force_N = 0.33f * x, in->zc_known = false;
}
static void carries_more_clipped(guard_in_t *in, float x, int ms) {
  (void)ms, in->force_N = 0.33f * x, in->acc_b_mps2.x = 300.0f;
}
static void full_thrust_unknown(guard_in_t *in, float x, int ms) {
  (void)ms, in->thrust_N = x, in->zc_known = false;
}
static void range_stops_unknown(guard_in_t *in, float x, int ms) {
  (void)ms, (void)x, in->range_new = false, in->zc_known = false;
}
static void range_stops_at(guard_in_t *in, float x, int ms) {
  (void)ms, in->range_new = false, in->zc_m = x;
}
static void range_at_floor(guard_in_t *in, float x, int ms) {
  (void)ms;
  in->zc_m = 0.1f;
  if (in->range_new) in->range_m = x;
}
static void range_odd_unknown(guard_in_t *in, float x, int ms) {
  (void)ms, in->zc_known = false;
  if (in->range_new) in->range_m = x;
}
static void blind_unknown(guard_in_t *in, float x, int ms) {
  (void)ms, in->zc_m = 0.03f, in->blind_s = x, in->zc_known = false;
}
static void floor_freezes(guard_in_t *in, float x, int ms) {
  if (in->range_new) in->range_m = 0.044f;
  in->pos_w_m.z += x * (float)(ms / 500);
}

static const struct {
  const char *what;
  unsigned silent;
  const hover_t *hover;
  hovering_edit_fn *edit;
  float value;
} silent[] = {
    {"carries much, no ceiling known", GUARD_RATIO, &HOVERING_FREE, carries_more_unknown, 1.3f},
    {"carries much, accelerometer clipped", GUARD_RATIO, &HOVERING_FREE, carries_more_clipped, 1.3f},
    {"carries much, near", GUARD_RATIO, &HOVERING_NEAR, carries_more, 1.3f},
    {"full thrust, no ceiling known", GUARD_SATURATED, &HOVERING_NEAR, full_thrust_unknown, 0.6f},
    {"full thrust, far", GUARD_SATURATED, &HOVERING_FREE, thrust, 0.6f},
    {"range stops, no ceiling was near", GUARD_RANGE_LOST, &HOVERING_FREE, range_stops_unknown, 0.0f},
    {"range stops, far", GUARD_RANGE_LOST, &HOVERING_FREE, range_stops_at, 0.2f},
    {"range stops, nearer than it sees", GUARD_RANGE_LOST, &HOVERING_NEAR, range_stops_at, 0.0499f},
    {"a sample of the sensor's floor", GUARD_RANGE_ODD, &HOVERING_NEAR, range_at_floor, 0.0449f},
    {"any sample, no ceiling known", GUARD_RANGE_ODD, &HOVERING_FREE, range_odd_unknown, 0.1f},
    {"a sample of 1 cm", GUARD_RANGE_ODD, &HOVERING_FREE, range_odd_unknown, CEILING_RANGE_MIN_M},
    {"a sample of 4 m", GUARD_RANGE_ODD, &HOVERING_FREE, range_odd_unknown, 4.0f},
    {"blind, no ceiling known", GUARD_BLIND, &HOVERING_NEAR, blind_unknown, 10.0f},
    {"the sensor's floor again and again", GUARD_RANGE_FROZEN, &HOVERING_NEAR, floor_freezes, 0.02f},
};

TEST(guard_is_silent_where_a_reason_needs_more_than_one_sign) {
  for (unsigned i = 0; i < sizeof silent / sizeof *silent; i++) {
    ROW("%s", silent[i].what);
    watched_t w = hovering_started(silent[i].hover);
    hovering_fly(&w, silent[i].hover, silent[i].edit, silent[i].value, 2000);
    CHECK((w.g.latched & silent[i].silent) == 0);
  }
}

static const struct {
  const char *what;
  float range_m, height_gap_m, wanted_m, since_step_s; // of the accelerometer's bias
  int before, after;
} summed[] = {
    {"as the height has it, nearer than wanted", 0.050f, 0.064f, 0.08f, 2.0f, 0, 1},
    {"the height does not know it", 0.050f, 0.0651f, 0.08f, 2.0f, 0, 2},
    {"at the floor, the height knows", 0.0449f, 0.05f, 0.08f, 2.0f, 0, 1},
    {"at the floor, the height does not", 0.0449f, 0.08f, 0.08f, 2.0f, 0, 4},
    {"not nearer than wanted by 15 mm", 0.050f, 0.08f, 0.0649f, 2.0f, 5, 3},
    {"nearer than wanted by 15 mm", 0.050f, 0.08f, 0.0651f, 2.0f, 5, 7},
    {"just not at the floor", 0.045f, 0.08f, 0.10f, 2.0f, 0, 2},
    {"just not very near", 0.055f, 0.08f, 0.10f, 2.0f, 5, 3},
    {"not very near", 0.0551f, 0.08f, 0.10f, 2.0f, 5, 3},
    {"just very near", 0.0549f, 0.08f, 0.10f, 2.0f, 5, 7},
    {"just after a step of the bias", 0.050f, 0.08f, 0.10f, 1.9f, 5, 3},
    {"just after a step, at the floor", 0.0449f, 0.08f, 0.10f, 1.9f, 5, 9},
    {"no distance", 0.0f, 0.08f, 0.10f, 2.0f, 5, 3},
    {"no number", NAN, 0.08f, 0.10f, 2.0f, 5, 3},
    {"nothing wanted", 0.050f, 0.08f, NAN, 2.0f, 5, 3},
    {"little left", 0.30f, 0.30f, 0.30f, 2.0f, 3, 1},
    {"least left", 0.30f, 0.30f, 0.30f, 2.0f, 2, 0},
    {"nothing left", 0.30f, 0.30f, 0.30f, 2.0f, 1, 0},
    {"to the end", 0.0449f, 0.08f, 0.10f, 2.0f, 19, 20},
    {"at the end", 0.0449f, 0.08f, 0.10f, 2.0f, 20, 20},
    {"a flipped bit", 0.0449f, 0.08f, 0.10f, 2.0f, 21, 4},
    {"a flipped sign", 0.0449f, 0.08f, 0.10f, 2.0f, -1, 4},
};

TEST(guard_sums_up_what_range_samples_say_of_a_ceiling_that_is_too_near) {
  const guard_param_t p = hovering_param();
  for (unsigned i = 0; i < sizeof summed / sizeof *summed; i++) {
    ROW("%s", summed[i].what);
    watched_t w = hovering_started(&HOVERING_FREE);
    const hover_t h = {summed[i].height_gap_m, summed[i].wanted_m, summed[i].range_m, 1.0f};
    guard_in_t in = hovering(&h, w.ms);
    in.range_new = true;
    in.range_m = summed[i].range_m;
    w.g.bias_s = summed[i].since_step_s;
    w.g.nearer = summed[i].before;
    guard_step(&w.g, &p, &in);
    CHECK_NEAR(w.g.nearer, summed[i].after, 0);
    CHECK(((w.g.now & GUARD_TOO_NEAR) != 0) == (w.g.nearer >= 14));
  }
  for (int sum = 12; sum <= 16; sum++) { // between samples nothing changes
    ROW("a sum of %d", sum);
    watched_t w = hovering_started(&HOVERING_FREE);
    guard_in_t in = hovering(&HOVERING_FREE, 1);
    w.g.nearer = sum;
    guard_step(&w.g, &p, &in);
    CHECK(w.g.nearer == sum && ((w.g.now & GUARD_TOO_NEAR) != 0) == (sum >= 14));
  }
}

TEST(guard_counts_to_the_end_and_stops) {
  const guard_param_t p = hovering_param();
  guard_t g;
  guard_init(&g);
  for (int k = 0; k < 3000; k++) { // 3,000 s of everything that lasts
    guard_in_t in = hovering(&HOVERING_NEAR, 1);
    in.ms = 1000;
    in.setpoint_good = false;
    in.range_new = k % 3 != 0;
    in.range_m = 0.1f;
    in.thrust_N = 0.6f;
    in.height_off_m = 2.0f;
    in.q_wb = (quat_t){.w = 0.5f, .x = 0.8660254f};
    in.on_floor = true;
    in.carries = k < 100;
    guard_step(&g, &p, &in);
  }
  const int counted[] = {g.retreat_ms,    g.handed_ms,    g.tilt_ms,      g.setpoint_ms, g.full_ms,
                         g.range_ms,      g.quiet_ms,     g.rate_same_ms, g.off_ms,      g.floor_ms,
                         g.range_same_ms, g.range_new_ms, g.range_same,   g.vel_calm_ms, g.ratio_ms};
  for (unsigned i = 0; i < sizeof counted / sizeof *counted; i++) {
    ROW("counter %u", i);
    CHECK(counted[i] >= 0 && counted[i] <= 1000000);
  }
  CHECK(g.tilt_ms == 1000000 && g.off_ms == 1000000 && g.range_same_ms == 1000000 && g.range_same == 3);
}
