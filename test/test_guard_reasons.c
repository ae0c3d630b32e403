// test_guard_reasons.c - each reason of the guard at its threshold, from both sides, in value and in
// duration.
#include "flight/flight.h"
#include "hovering.h"
#include "test.h"

#include <limits.h>

static const hover_t FREE = {0.30f, 0.30f, 0.30f, 1.0f}, NEAR = {0.10f, 0.10f, 0.10f, 1.0f};

typedef void edit_fn(guard_in_t *in, float value, int ms); // ms: since the fault began

static guard_param_t param(void) {
  flight_param_t p;
  params_default(&p);
  return p.guard;
}

typedef struct {
  guard_t g;
  int ms, since_ms; // of the flight, of the fault
} watched_t;

static void fly(watched_t *w, const hover_t *h, edit_fn *edit, float value, int span_ms) {
  const guard_param_t p = param();
  for (int k = 0; k < span_ms; k++) {
    guard_in_t in = hovering(h, w->ms++);
    if (edit) edit(&in, value, ++w->since_ms);
    guard_step(&w->g, &p, &in);
  }
}

static watched_t in_hover(const hover_t *h) {
  watched_t w = {.ms = 1};
  guard_init(&w.g);
  fly(&w, h, NULL, 0.0f, 3000);
  CHECK(w.g.now == 0 && w.g.latched == 0 && w.g.action == GUARD_FLY);
  return w;
}

static void rate_x(guard_in_t *in, float x, int ms) {
  (void)ms, in->rate_b_radps.x = x;
}
static void rate_z(guard_in_t *in, float x, int ms) {
  (void)ms, in->rate_b_radps.z = x;
}
static void acc_y(guard_in_t *in, float x, int ms) {
  (void)ms, in->acc_b_mps2.y = x;
}
static void pos_x(guard_in_t *in, float x, int ms) {
  (void)ms, in->pos_w_m.x = x;
}
static void vel_y(guard_in_t *in, float x, int ms) {
  (void)ms, in->vel_w_mps.y = x;
}
static void attitude_size(guard_in_t *in, float x, int ms) {
  (void)ms, in->q_wb.w = x;
}
// By so many degrees about x; what is felt turns with it.
static void tilted(guard_in_t *in, float deg, int ms) {
  (void)ms;
  const float half = deg / 2.0f / 57.29578f;
  in->q_wb = (quat_t){.w = cosf(half), .x = sinf(half)};
  in->acc_b_mps2 = quat_to_body(in->q_wb, in->acc_b_mps2);
}
static void gyro_stops(guard_in_t *in, float x, int ms) {
  (void)ms, in->rate_b_radps = (v3_t){x, x, x};
}
static void acc_stops(guard_in_t *in, float x, int ms) {
  (void)ms, in->acc_b_mps2 = (v3_t){x, x, 9.81f};
}
static void range_stops(guard_in_t *in, float x, int ms) {
  (void)x, (void)ms, in->range_new = false;
}
// Samples that mean nothing; every tenth of a second as the true ones.
static void range_says(guard_in_t *in, float x, int ms) {
  (void)ms;
  if (in->range_new) in->range_m = x;
}
static void range_off_by(guard_in_t *in, float x, int ms) {
  (void)ms;
  if (in->range_new) in->range_m = in->zc_m + x;
}
// The same sample again and again, while it climbs by x.
static void range_freezes(guard_in_t *in, float x, int ms) {
  if (in->range_new) in->range_m = 0.10f;
  in->range_new = ms % 100 == 1;
  if (in->range_new) in->range_m = 0.10f;
  if (ms > 1) in->pos_w_m.z += x;
}
static void blind_for(guard_in_t *in, float x, int ms) {
  (void)ms, in->zc_m = 0.0499f, in->blind_s = x;
}
static void blind_at(guard_in_t *in, float x, int ms) {
  (void)ms, in->zc_m = x, in->blind_s = 100.0f;
}
static void thrust(guard_in_t *in, float x, int ms) {
  (void)ms, in->thrust_N = x;
}
static void full_thrust_at(guard_in_t *in, float x, int ms) {
  (void)ms, in->thrust_N = 0.6f, in->zc_m = x;
}
static void setpoint_bad(guard_in_t *in, float x, int ms) {
  (void)ms;
  if (x > 0.0f) in->setpoint_good = false;
}
static void velocity_jumps(guard_in_t *in, float x, int ms) {
  in->vel_w_mps.x = ms % 2 ? x : 0.0f;
}
static void carries_more(guard_in_t *in, float x, int ms) {
  (void)ms, in->force_N = 0.33f * x;
}
static void carries_more_at(guard_in_t *in, float x, int ms) {
  (void)ms, in->force_N = 0.33f * 1.2f, in->zc_m = x;
}
static void height_off(guard_in_t *in, float x, int ms) {
  (void)ms, in->height_off_m = x;
}

TEST(guard_raises_each_reason_at_its_threshold) {
  static const struct {
    const char *what;
    guard_reason_t reason;
    const hover_t *hover;
    edit_fn *edit;
    float below, at;
    int ms; // from `at` on until it is raised
  } row[] = {
      {"rate", GUARD_NOT_A_NUMBER, &FREE, rate_x, 34.5f, 34.51f, 1},
      {"rate, the other way", GUARD_NOT_A_NUMBER, &FREE, rate_z, -34.5f, -34.51f, 1},
      {"rate NaN", GUARD_NOT_A_NUMBER, &FREE, rate_z, 0.0f, NAN, 1},
      {"acceleration", GUARD_NOT_A_NUMBER, &FREE, acc_y, 1000.0f, 1000.1f, 1},
      {"position", GUARD_NOT_A_NUMBER, &FREE, pos_x, 1e4f, 1.0001e4f, 1},
      {"velocity", GUARD_NOT_A_NUMBER, &FREE, vel_y, 20.0f, 20.01f, 1},
      {"attitude too long", GUARD_NOT_A_NUMBER, &FREE, attitude_size, 2.0f, 2.001f, 1},
      {"attitude too short", GUARD_NOT_A_NUMBER, &FREE, attitude_size, 0.5f, 0.499f, 1},
      {"gyro the same", GUARD_GYRO_FROZEN, &FREE, gyro_stops, NAN, 0.02f, 26},
      {"accelerometer the same", GUARD_ACC_FROZEN, &FREE, acc_stops, NAN, 0.02f, 26},
      {"acceleration clipped", GUARD_ACC_CLIPPED, &FREE, acc_y, 196.2f, 196.21f, 1},
      {"tilt", GUARD_TILT, &FREE, tilted, 59.9f, 60.1f, 1},
      {"range stops, near", GUARD_RANGE_LOST, &NEAR, range_stops, NAN, 0.0f, 0},
      {"range no distance", GUARD_RANGE_ODD, &FREE, range_says, NAN, 0.0099f, 0},
      {"range beyond the sensor's", GUARD_RANGE_ODD, &FREE, range_says, NAN, 4.01f, 0},
      {"range farther than explained", GUARD_RANGE_ODD, &FREE, range_off_by, 0.0499f, 0.0501f, 0},
      {"range nearer than explained", GUARD_RANGE_ODD, &FREE, range_off_by, -0.0499f, -0.0501f, 0},
      {"range the same in a climb", GUARD_RANGE_FROZEN, &NEAR, range_freezes, 0.0199f, 0.0201f, 301},
      {"range the same in a descent", GUARD_RANGE_FROZEN, &NEAR, range_freezes, -0.0199f, -0.0201f, 301},
      {"blind", GUARD_BLIND, &NEAR, blind_for, 3.0f, 3.01f, 1},
      {"blind so near", GUARD_BLIND, &NEAR, blind_at, 0.05f, 0.0499f, 1},
      {"full thrust near", GUARD_SATURATED, &NEAR, thrust, 0.98f * 0.6f, 0.9801f * 0.6f, 201},
      {"full thrust so near", GUARD_SATURATED, &NEAR, full_thrust_at, 0.2f, 0.1999f, 201},
      {"set point no number", GUARD_SETPOINT, &FREE, setpoint_bad, 0.0f, 1.0f, 1},
      {"velocity jumps", GUARD_VELOCITY, &FREE, velocity_jumps, 0.5f, 0.501f, 1},
      {"carries too much", GUARD_RATIO, &FREE, carries_more, 1.149f, 1.16f, 10},
      {"carries too much so far away", GUARD_RATIO, &FREE, carries_more_at, 0.11f, 0.1101f, 10},
      {"height reset", GUARD_HEIGHT_LOST, &FREE, height_off, 1.0f, 1.001f, 250},
      {"height reset downwards", GUARD_HEIGHT_LOST, &FREE, height_off, -1.0f, -1.001f, 250},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    watched_t w = in_hover(row[i].hover);
    if (!isnan(row[i].below)) {
      fly(&w, row[i].hover, row[i].edit, row[i].below, 1000);
      CHECK((w.g.latched & row[i].reason) == 0);
    }
    w = in_hover(row[i].hover);
    if (row[i].ms == 0) { // at the next sample, whenever it comes
      while (w.ms % 100 != 1) fly(&w, row[i].hover, NULL, 0.0f, 1);
      const int after_ms = row[i].reason == GUARD_RANGE_LOST ? 251 : 100;
      fly(&w, row[i].hover, row[i].edit, row[i].at, after_ms - 1);
      CHECK((w.g.latched & row[i].reason) == 0);
      fly(&w, row[i].hover, row[i].edit, row[i].at, 1);
    } else {
      fly(&w, row[i].hover, row[i].edit, row[i].at, row[i].ms - 1);
      CHECK((w.g.latched & row[i].reason) == 0);
      fly(&w, row[i].hover, row[i].edit, row[i].at, 1);
    }
    CHECK((w.g.now & row[i].reason) != 0);
  }
}

// What is done about it: from when on, and by then not yet.
TEST(guard_acts_after_so_long) {
  static const struct {
    const char *what;
    const hover_t *hover;
    edit_fn *edit;
    float value;
    int ms;
    guard_action_t want;
  } row[] = {
      {"rate NaN", &FREE, rate_z, NAN, 51, GUARD_HAND_OVER},
      {"gyro the same", &FREE, gyro_stops, 0.02f, 101, GUARD_HAND_OVER},
      {"accelerometer the same", &FREE, acc_stops, 0.02f, 26, GUARD_RETREAT},
      {"tilt", &FREE, tilted, 61.0f, 101, GUARD_HAND_OVER},
      {"set point no number", &FREE, setpoint_bad, 1.0f, 251, GUARD_RETREAT},
      {"velocity jumps", &FREE, velocity_jumps, 1.0f, 1, GUARD_RETREAT},
      {"full thrust near", &NEAR, thrust, 0.6f, 201, GUARD_RETREAT},
      {"carries too much", &FREE, carries_more, 1.2f, 10, GUARD_RETREAT},
      {"height reset", &FREE, height_off, 1.5f, 250, GUARD_RETREAT},
      {"blind", &NEAR, blind_for, 5.0f, 1, GUARD_RETREAT},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    watched_t w = in_hover(row[i].hover);
    fly(&w, row[i].hover, row[i].edit, row[i].value, row[i].ms - 1);
    CHECK(w.g.action == (row[i].edit == setpoint_bad ? GUARD_HOLD : GUARD_FLY));
    CHECK(w.g.retreat_ms == 0 && w.g.handed_ms == 0);
    fly(&w, row[i].hover, row[i].edit, row[i].value, 1);
    CHECK(w.g.action == row[i].want);
  }
}

TEST(guard_follows_what_the_thrust_usually_carries_slowly_up_and_quickly_down) {
  watched_t w = in_hover(&FREE);
  CHECK_NEAR(w.g.ratio_usual, 1.0, 1e-6);
  fly(&w, &FREE, carries_more, 1.1f, 3000);
  CHECK_NEAR(w.g.ratio_usual, 1.1 - 0.1 * exp(-3.0 / 5.0), 1e-4);
  const double before = (double)w.g.ratio_usual;
  fly(&w, &FREE, carries_more, 0.9f, 1000);
  CHECK_NEAR(w.g.ratio_usual, 0.9 + (before - 0.9) * exp(-1.0 / 2.0), 1e-4);
  CHECK(w.g.latched == 0);
}

TEST(guard_knows_what_is_usual_after_a_second_in_the_air) {
  const guard_param_t p = param();
  guard_t g;
  guard_init(&g);
  for (int ms = 1; ms <= 1100; ms++) {
    guard_in_t in = hovering(&FREE, ms);
    in.force_N = 0.33f * (1.0f + 0.001f * (float)ms);
    guard_step(&g, &p, &in);
    if (ms < 999) CHECK_NEAR(g.ratio_usual, 1.0 + 0.001 * ms, 1e-5); // as it comes
    if (ms == 1100) CHECK_NEAR(g.ratio_usual, 2.0, 5e-3);            // held
  }
  guard_in_t in = hovering(&FREE, 1101); // no thrust: what is felt is no ratio of it
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

TEST(guard_is_silent_where_a_reason_needs_more_than_one_sign) {
  static const struct {
    const char *what;
    unsigned silent;
    const hover_t *hover;
    edit_fn *edit;
    float value;
  } row[] = {
      {"carries much, no ceiling known", GUARD_RATIO, &FREE, carries_more_unknown, 1.3f},
      {"carries much, accelerometer clipped", GUARD_RATIO, &FREE, carries_more_clipped, 1.3f},
      {"carries much, near", GUARD_RATIO, &NEAR, carries_more, 1.3f},
      {"full thrust, no ceiling known", GUARD_SATURATED, &NEAR, full_thrust_unknown, 0.6f},
      {"full thrust, far", GUARD_SATURATED, &FREE, thrust, 0.6f},
      {"range stops, no ceiling was near", GUARD_RANGE_LOST, &FREE, range_stops_unknown, 0.0f},
      {"range stops, far", GUARD_RANGE_LOST, &FREE, range_stops_at, 0.2f},
      {"range stops, nearer than it sees", GUARD_RANGE_LOST, &NEAR, range_stops_at, 0.0499f},
      {"a sample of the sensor's floor", GUARD_RANGE_ODD, &NEAR, range_at_floor, 0.0449f},
      {"any sample, no ceiling known", GUARD_RANGE_ODD, &FREE, range_odd_unknown, 0.1f},
      {"a sample of 1 cm", GUARD_RANGE_ODD, &FREE, range_odd_unknown, GUARD_RANGE_MIN_M},
      {"a sample of 4 m", GUARD_RANGE_ODD, &FREE, range_odd_unknown, 4.0f},
      {"blind, no ceiling known", GUARD_BLIND, &NEAR, blind_unknown, 10.0f},
      {"the sensor's floor again and again", GUARD_RANGE_FROZEN, &NEAR, floor_freezes, 0.02f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    watched_t w = in_hover(row[i].hover);
    fly(&w, row[i].hover, row[i].edit, row[i].value, 2000);
    CHECK((w.g.latched & row[i].silent) == 0);
  }
}

TEST(guard_sums_up_what_range_samples_say_of_a_ceiling_that_is_too_near) {
  static const struct {
    const char *what;
    float range_m, height_gap_m, wanted_m, since_step_s; // of the accelerometer's bias
    int before, after;
  } row[] = {
      {"as the height has it, nearer than wanted", 0.050f, 0.064f, 0.08f, 2.0f, 0, 1},
      {"the height does not know it", 0.050f, 0.0651f, 0.08f, 2.0f, 0, 2},
      {"at the floor, the height knows", 0.0449f, 0.05f, 0.08f, 2.0f, 0, 1},
      {"at the floor, the height does not", 0.0449f, 0.08f, 0.08f, 2.0f, 0, 4},
      {"not nearer than wanted by 15 mm", 0.050f, 0.08f, 0.0649f, 2.0f, 5, 3},
      {"nearer than wanted by 15 mm", 0.050f, 0.08f, 0.0651f, 2.0f, 5, 7},
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
  const guard_param_t p = param();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    watched_t w = in_hover(&FREE);
    const hover_t h = {row[i].height_gap_m, row[i].wanted_m, row[i].range_m, 1.0f};
    guard_in_t in = hovering(&h, w.ms);
    in.range_new = true;
    in.range_m = row[i].range_m;
    w.g.bias_s = row[i].since_step_s;
    w.g.nearer = row[i].before;
    guard_step(&w.g, &p, &in);
    CHECK_NEAR(w.g.nearer, row[i].after, 0);
    CHECK(((w.g.now & GUARD_TOO_NEAR) != 0) == (w.g.nearer >= 14));
  }
  for (int sum = 12; sum <= 16; sum++) { // between samples nothing changes
    ROW("a sum of %d", sum);
    watched_t w = in_hover(&FREE);
    guard_in_t in = hovering(&FREE, 1);
    w.g.nearer = sum;
    guard_step(&w.g, &p, &in);
    CHECK(w.g.nearer == sum && ((w.g.now & GUARD_TOO_NEAR) != 0) == (sum >= 14));
  }
}

TEST(guard_counts_to_the_end_and_stops) {
  const guard_param_t p = param();
  guard_t g;
  guard_init(&g);
  for (int k = 0; k < 3000; k++) { // 3,000 s of everything that lasts
    guard_in_t in = hovering(&NEAR, 1);
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

// A retreat ends with its reasons, a second later, and with another wish of the pilot's.
TEST(guard_flies_on_after_a_retreat_when_all_is_well_and_another_height_is_asked_for) {
  static const struct {
    const char *what;
    int quiet_ms;
    float other_m;
    bool good;
    guard_action_t want;
  } row[] = {
      {"a second, 1.1 cm", 1001, 0.011f, true, GUARD_FLY},
      {"a second, 1.1 cm down", 1001, -0.011f, true, GUARD_FLY},
      {"a second, 0.9 cm", 1001, 0.009f, true, GUARD_RETREAT},
      {"not a second", 1000, 0.011f, true, GUARD_RETREAT},
      {"a set point that is none", 1001, 0.011f, false, GUARD_RETREAT},
  };
  const guard_param_t p = param();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    watched_t w = in_hover(&FREE);
    fly(&w, &FREE, height_off, 2.0f, 300);
    CHECK(w.g.action == GUARD_RETREAT);
    CHECK_NEAR(w.g.hold_z_m, HOVERING_CEILING_M - 0.3f, 1e-6);
    CHECK_NEAR(w.g.asked_at_m, HOVERING_CEILING_M - 0.3f, 1e-6);
    CHECK_NEAR(w.g.retreat_ms, 50, 0);
    fly(&w, &FREE, NULL, 0.0f, row[i].quiet_ms - 1);
    CHECK(w.g.action == GUARD_RETREAT);
    guard_in_t in = hovering(&FREE, w.ms);
    in.asked_z_m += row[i].other_m;
    in.setpoint_good = row[i].good;
    guard_step(&w.g, &p, &in);
    CHECK(w.g.action == row[i].want);
  }
}

TEST(guard_refuses_a_take_off_where_there_is_no_room) {
  static const struct {
    const char *what;
    float range_m, thrust_N;
    bool wanted, flown, refused;
  } row[] = {
      {"9.9 cm", 0.099f, 0.0f, true, false, true},
      {"10 cm", 0.1f, 0.0f, true, false, false},
      {"no range", 0.0f, 0.0f, true, false, false},
      {"with some thrust", 0.099f, 0.098f, true, false, true},
      {"with more thrust: it flies", 0.099f, 0.1f, true, false, false},
      {"not wanted", 0.099f, 0.0f, false, false, false},
      {"in flight", 0.099f, 0.0f, true, true, false},
  };
  const guard_param_t p = param();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    guard_t g;
    guard_init(&g);
    for (int ms = 0; ms < 300; ms++) {
      const hover_t h = {0.3f, 0.3f, row[i].range_m, 1.0f};
      guard_in_t in = hovering(&h, ms);
      in.range_m = row[i].range_m;
      in.wanted = row[i].wanted && ms > 200;
      in.carries = row[i].flown && ms < 250;
      in.thrust_N = row[i].thrust_N;
      in.zc_known = false;
      guard_step(&g, &p, &in);
    }
    CHECK(((g.now & GUARD_NO_ROOM) != 0) == row[i].refused);
    CHECK((g.action == GUARD_HAND_OVER) == row[i].refused);
    CHECK(guard_thrust_N(&g, &p, 0.33f) == 0.0f || !row[i].refused);
  }
}

TEST(guard_gives_less_than_hover_thrust_in_a_hand_over_and_then_none) {
  const guard_param_t p = param();
  static const struct {
    const char *what;
    float hover_N;
    int handed_ms;
    unsigned now;
    float want_N;
  } row[] = {
      {"known hover thrust", 0.30f, 100, GUARD_NOT_A_NUMBER, 0.27f},
      {"until cutAfter", 0.30f, 1500, GUARD_NOT_A_NUMBER, 0.27f},
      {"after cutAfter", 0.30f, 1501, GUARD_NOT_A_NUMBER, 0.0f},
      {"tilted", 0.30f, 100, GUARD_TILT, 0.0f},
      {"gyro frozen", 0.30f, 100, GUARD_GYRO_FROZEN, 0.0f},
      {"hover thrust too large", 1.0f, 100, 0, 0.9f * 1.3f * 0.33f},
      {"no hover thrust known", 0.0f, 100, 0, 0.9f * 0.5f * 0.33f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const guard_t g = {.hover_N = row[i].hover_N, .handed_ms = row[i].handed_ms, .now = row[i].now};
    CHECK_NEAR(guard_thrust_N(&g, &p, 0.33f), row[i].want_N, 1e-6);
  }
}

TEST(guard_goes_down_to_its_safe_gap_at_its_speed) {
  const guard_param_t p = {.safe_gap_m = 0.35f, .sink_mps = 0.3f};
  static const struct {
    const char *what;
    float hold_m, z_m, ceiling_m;
    int retreat_ms;
    float want_m;
  } row[] = {
      {"at first where it is", 1.9f, 1.9f, 2.0f, 0, 1.9f},
      {"half a speed", 1.9f, 1.9f, 2.0f, 50, 1.75f},
      {"full speed", 1.9f, 1.9f, 2.0f, 100, 1.65f},
      {"full speed from higher", 2.2f, 2.2f, 2.0f, 500, 1.9f},
      {"the safe gap", 1.9f, 1.7f, 2.0f, 500, 1.65f},
      {"it was lower already", 1.2f, 1.2f, 2.0f, 500, 1.2f},
      {"no ceiling known", 1.2f, 1.2f, NAN, 500, 0.9f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const guard_t g = {.hold_z_m = row[i].hold_m, .retreat_ms = row[i].retreat_ms};
    CHECK_NEAR(guard_retreat_z_m(&g, &p, row[i].z_m, row[i].ceiling_m), row[i].want_m, 1e-6);
  }
}
