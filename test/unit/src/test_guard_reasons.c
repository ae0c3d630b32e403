// test_guard_reasons.c - each reason of the guard at its threshold, from both sides, in value and in
// duration; and the table of them.
#include "flight/flight.h"
#include "rig/hovering.h"
#include "rig/test.h"

#include <string.h>

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

static const struct {
  const char *what;
  guard_reason_t reason;
  const hover_t *hover;
  hovering_edit_fn *edit;
  float below, at;
  int ms; // from `at` on until it is raised
} raised[] = {
    {"rate", GUARD_NOT_A_NUMBER, &HOVERING_FREE, rate_x, 34.5f, 34.51f, 1},
    {"rate, the other way", GUARD_NOT_A_NUMBER, &HOVERING_FREE, rate_z, -34.5f, -34.51f, 1},
    {"rate NaN", GUARD_NOT_A_NUMBER, &HOVERING_FREE, rate_z, 0.0f, NAN, 1},
    {"acceleration", GUARD_NOT_A_NUMBER, &HOVERING_FREE, acc_y, 1000.0f, 1000.1f, 1},
    {"position", GUARD_NOT_A_NUMBER, &HOVERING_FREE, pos_x, 1e4f, 1.0001e4f, 1},
    {"velocity", GUARD_NOT_A_NUMBER, &HOVERING_FREE, vel_y, 20.0f, 20.01f, 1},
    {"attitude too long", GUARD_NOT_A_NUMBER, &HOVERING_FREE, attitude_size, 2.0f, 2.001f, 1},
    {"attitude too short", GUARD_NOT_A_NUMBER, &HOVERING_FREE, attitude_size, 0.5f, 0.499f, 1},
    {"gyro the same", GUARD_GYRO_FROZEN, &HOVERING_FREE, gyro_stops, NAN, 0.02f, 26},
    {"accelerometer the same", GUARD_ACC_FROZEN, &HOVERING_FREE, acc_stops, NAN, 0.02f, 26},
    {"acceleration clipped", GUARD_ACC_CLIPPED, &HOVERING_FREE, acc_y, 196.2f, 196.21f, 1},
    {"tilt", GUARD_TILT, &HOVERING_FREE, tilted, 59.9f, 60.1f, 1},
    {"range stops, near", GUARD_RANGE_LOST, &HOVERING_NEAR, range_stops, NAN, 0.0f, 0},
    {"range no distance", GUARD_RANGE_ODD, &HOVERING_FREE, range_says, NAN, 0.0099f, 0},
    {"range beyond the sensor's", GUARD_RANGE_ODD, &HOVERING_FREE, range_says, NAN, 4.01f, 0},
    {"range farther than explained", GUARD_RANGE_ODD, &HOVERING_FREE, range_off_by, 0.0499f, 0.0501f, 0},
    {"range nearer than explained", GUARD_RANGE_ODD, &HOVERING_FREE, range_off_by, -0.0499f, -0.0501f, 0},
    {"range the same in a climb", GUARD_RANGE_FROZEN, &HOVERING_NEAR, range_freezes, 0.0199f, 0.0201f, 301},
    {"range the same in a descent", GUARD_RANGE_FROZEN, &HOVERING_NEAR, range_freezes, -0.0199f, -0.0201f,
     301},
    {"blind", GUARD_BLIND, &HOVERING_NEAR, blind_for, 3.0f, 3.01f, 1},
    {"blind so near", GUARD_BLIND, &HOVERING_NEAR, blind_at, 0.05f, 0.0499f, 1},
    {"full thrust near", GUARD_SATURATED, &HOVERING_NEAR, thrust, 0.98f * 0.6f, 0.9801f * 0.6f, 201},
    {"full thrust so near", GUARD_SATURATED, &HOVERING_NEAR, full_thrust_at, 0.2f, 0.1999f, 201},
    {"set point no number", GUARD_SETPOINT, &HOVERING_FREE, setpoint_bad, 0.0f, 1.0f, 1},
    {"velocity jumps", GUARD_VELOCITY, &HOVERING_FREE, velocity_jumps, 0.5f, 0.501f, 1},
    {"carries too much", GUARD_RATIO, &HOVERING_FREE, carries_more, 1.149f, 1.5f, 45},
    {"carries too much so far away", GUARD_RATIO, &HOVERING_FREE, carries_more_at, 0.11f, 0.1101f, 154},
    {"height reset", GUARD_HEIGHT_LOST, &HOVERING_FREE, height_off, 1.0f, 1.001f, 250},
    {"height reset downwards", GUARD_HEIGHT_LOST, &HOVERING_FREE, height_off, -1.0f, -1.001f, 250},
};

TEST(guard_raises_each_reason_at_its_threshold) {
  for (unsigned i = 0; i < sizeof raised / sizeof *raised; i++) {
    ROW("%s", raised[i].what);
    watched_t w = hovering_started(raised[i].hover);
    if (!isnan(raised[i].below)) {
      hovering_fly(&w, raised[i].hover, raised[i].edit, raised[i].below, 1000);
      CHECK((w.g.latched & raised[i].reason) == 0);
    }
    w = hovering_started(raised[i].hover);
    if (raised[i].ms == 0) { // at the next sample, whenever it comes
      while (w.ms % 100 != 1) hovering_fly(&w, raised[i].hover, NULL, 0.0f, 1);
      const int after_ms = raised[i].reason == GUARD_RANGE_LOST ? 251 : 100;
      hovering_fly(&w, raised[i].hover, raised[i].edit, raised[i].at, after_ms - 1);
      CHECK((w.g.latched & raised[i].reason) == 0);
      hovering_fly(&w, raised[i].hover, raised[i].edit, raised[i].at, 1);
    } else {
      hovering_fly(&w, raised[i].hover, raised[i].edit, raised[i].at, raised[i].ms - 1);
      CHECK((w.g.latched & raised[i].reason) == 0);
      hovering_fly(&w, raised[i].hover, raised[i].edit, raised[i].at, 1);
    }
    CHECK((w.g.now & raised[i].reason) != 0);
  }
}

// What is done about it: from when on, and by then not yet.
static const struct {
  const char *what;
  const hover_t *hover;
  hovering_edit_fn *edit;
  float value;
  int ms;
  guard_action_t want;
} acted[] = {
    {"rate NaN", &HOVERING_FREE, rate_z, NAN, 51, GUARD_HAND_OVER},
    {"gyro the same", &HOVERING_FREE, gyro_stops, 0.02f, 101, GUARD_HAND_OVER},
    {"accelerometer the same", &HOVERING_FREE, acc_stops, 0.02f, 26, GUARD_RETREAT},
    {"tilt", &HOVERING_FREE, tilted, 61.0f, 101, GUARD_HAND_OVER},
    {"set point no number", &HOVERING_FREE, setpoint_bad, 1.0f, 251, GUARD_RETREAT},
    {"velocity jumps", &HOVERING_FREE, velocity_jumps, 1.0f, 1, GUARD_RETREAT},
    {"full thrust near", &HOVERING_NEAR, thrust, 0.6f, 201, GUARD_RETREAT},
    {"carries too much", &HOVERING_FREE, carries_more, 1.5f, 45, GUARD_RETREAT},
    {"height reset", &HOVERING_FREE, height_off, 1.5f, 250, GUARD_RETREAT},
    {"blind", &HOVERING_NEAR, blind_for, 5.0f, 1, GUARD_RETREAT},
};

TEST(guard_acts_after_so_long) {
  for (unsigned i = 0; i < sizeof acted / sizeof *acted; i++) {
    ROW("%s", acted[i].what);
    watched_t w = hovering_started(acted[i].hover);
    hovering_fly(&w, acted[i].hover, acted[i].edit, acted[i].value, acted[i].ms - 1);
    CHECK(w.g.action == (acted[i].edit == setpoint_bad ? GUARD_HOLD : GUARD_FLY));
    CHECK(w.g.retreat_ms == 0 && w.g.handed_ms == 0);
    hovering_fly(&w, acted[i].hover, acted[i].edit, acted[i].value, 1);
    CHECK(w.g.action == acted[i].want);
  }
}

// --- the table --------------------------------------------------------------------------------------------

#define ROW_OF(bit_, reason, lasts, down_, ends, gone, words_) {bit_, down_, #reason, words_},
static const struct {
  int bit, down_ms;
  const char *name, *words;
} table[] = {GUARD_REASONS(ROW_OF)};
enum { ROWS = sizeof table / sizeof *table };

TEST(guard_has_a_bit_and_words_of_its_own_for_each_reason) {
  unsigned bits = 0;
  for (unsigned i = 0; i < ROWS; i++) {
    ROW("%s", table[i].name);
    CHECK(table[i].bit < ROWS && (bits & 1u << table[i].bit) == 0);
    bits |= 1u << table[i].bit;
    for (unsigned j = 0; j < i; j++) CHECK(strcmp(table[i].words, table[j].words) != 0);
  }
}

// While an input is no number the reasons of before stand, whichever they are.
TEST(guard_goes_down_at_once_for_the_reasons_whose_row_says_so) {
  const guard_param_t p = hovering_param();
  unsigned down = 0;
  for (unsigned i = 0; i < ROWS; i++) {
    ROW("%s", table[i].name);
    watched_t w = hovering_started(&HOVERING_FREE);
    w.g.now = 1u << table[i].bit;
    guard_in_t in = hovering(&HOVERING_FREE, w.ms);
    in.pos_w_m.x = NAN;
    guard_step(&w.g, &p, &in);
    CHECK((w.g.action == GUARD_RETREAT) == (table[i].down_ms == 0));
    if (w.g.action == GUARD_RETREAT) down |= 1u << table[i].bit;
  }
  CHECK(down == (GUARD_ACC_FROZEN | GUARD_RANGE_LOST | GUARD_RANGE_FROZEN | GUARD_BLIND | GUARD_SATURATED |
                 GUARD_TOO_NEAR | GUARD_VELOCITY | GUARD_RATIO | GUARD_HEIGHT_LOST));
}
