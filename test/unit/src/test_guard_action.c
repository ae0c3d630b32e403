// test_guard_action.c - what the guard does: the end of a retreat, refusals, heights and thrusts.
#include "flight/flight.h"
#include "rig/hovering.h"
#include "rig/test.h"

static void height_off(guard_in_t *in, float x, int ms) {
  (void)ms, in->height_off_m = x;
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
  const guard_param_t p = hovering_param();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    watched_t w = hovering_started(&HOVERING_FREE);
    hovering_fly(&w, &HOVERING_FREE, height_off, 2.0f, 300);
    CHECK(w.g.action == GUARD_RETREAT);
    CHECK_NEAR(w.g.hold_z_m, HOVERING_CEILING_M - 0.3f, 1e-6);
    CHECK_NEAR(w.g.asked_at_m, HOVERING_CEILING_M - 0.3f, 1e-6);
    CHECK_NEAR(w.g.retreat_ms, 50, 0);
    hovering_fly(&w, &HOVERING_FREE, NULL, 0.0f, row[i].quiet_ms - 1);
    CHECK(w.g.action == GUARD_RETREAT);
    guard_in_t in = hovering(&HOVERING_FREE, w.ms);
    in.asked_z_m += row[i].other_m;
    in.setpoint_good = row[i].good;
    guard_step(&w.g, &p, &in);
    CHECK(w.g.action == row[i].want);
  }
}

static void carries_more(guard_in_t *in, float x, int ms) {
  (void)ms, in->force_N *= x;
}

// Also where another reason began the retreat.
TEST(guard_notices_while_it_goes_down_that_a_ceiling_is_unseen) {
  for (int other = 0; other < 2; other++) {
    ROW(other ? "for another reason" : "for that");
    watched_t w = hovering_started(&HOVERING_FREE);
    hovering_fly(&w, &HOVERING_FREE, height_off, 2.0f * (float)other, 300);
    CHECK(w.g.action == (other ? GUARD_RETREAT : GUARD_FLY) && !w.g.unseen);
    hovering_fly(&w, &HOVERING_FREE, carries_more, 1.3f, 300);
    CHECK(w.g.action == GUARD_RETREAT && w.g.unseen);
  }
}

// The ceiling is nearer than the range says, and the pilot goes by the range.
TEST(guard_ends_a_retreat_from_a_ceiling_unseen_by_a_height_that_needs_no_climb) {
  static const struct {
    const char *what;
    float first_off_m, ratio, off_m, climb_m;
    guard_action_t want;
  } row[] = {
      {"thrust carries too much, up", 0.0f, 1.3f, 1.0f, 0.02f, GUARD_RETREAT},
      {"thrust carries too much, down, but above it", 0.0f, 1.3f, -0.05f, 0.01f, GUARD_RETREAT},
      {"thrust carries too much, down", 0.0f, 1.3f, -0.05f, -0.01f, GUARD_FLY},
      {"the same while it goes down for another reason", 2.0f, 1.3f, 1.0f, 0.02f, GUARD_RETREAT},
      {"another reason alone", 2.0f, 1.0f, 1.0f, 0.02f, GUARD_FLY},
  };
  const guard_param_t p = hovering_param();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    watched_t w = hovering_started(&HOVERING_FREE);
    hovering_fly(&w, &HOVERING_FREE, height_off, row[i].first_off_m, 300);
    hovering_fly(&w, &HOVERING_FREE, carries_more, row[i].ratio, 300);
    CHECK(w.g.action == GUARD_RETREAT);
    CHECK(w.g.unseen == (row[i].ratio > 1.0f));
    hovering_fly(&w, &HOVERING_FREE, NULL, 0.0f, 2000);
    guard_in_t in = hovering(&HOVERING_FREE, w.ms);
    in.asked_z_m += row[i].off_m;
    in.pos_w_m.z = in.asked_z_m - row[i].climb_m;
    guard_step(&w.g, &p, &in);
    CHECK(w.g.action == row[i].want);
  }
}

TEST(guard_forgets_a_ceiling_unseen_when_the_next_retreat_begins) {
  watched_t w = hovering_started(&HOVERING_FREE);
  w.g.unseen = true; // of an earlier one, or a bit flipped
  hovering_fly(&w, &HOVERING_FREE, height_off, 2.0f, 300);
  CHECK(w.g.action == GUARD_RETREAT && !w.g.unseen);
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
  const guard_param_t p = hovering_param();
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
  const guard_param_t p = hovering_param();
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
    float kp_per_s, want_m;
    bool unseen;
  } row[] = {
      {"at first where it is", 1.9f, 1.9f, 2.0f, 0, 1.0f, 1.9f, false},
      {"half a speed", 1.9f, 1.9f, 2.0f, 150, 1.0f, 1.75f, false},
      {"full speed", 1.9f, 1.9f, 2.0f, 300, 1.0f, 1.65f, false},
      {"full speed of a law of twice the gain", 1.9f, 1.9f, 2.0f, 300, 2.0f, 1.75f, false},
      {"full speed from higher", 2.2f, 2.2f, 2.0f, 500, 1.0f, 1.9f, false},
      {"the safe gap", 1.9f, 1.7f, 2.0f, 500, 1.0f, 1.65f, false},
      {"it was lower already", 1.2f, 1.2f, 2.0f, 500, 1.0f, 1.2f, false},
      {"no ceiling known", 1.2f, 1.2f, NAN, 500, 1.0f, 0.9f, false},
      {"a ceiling unseen: below where it is", 1.2f, 1.0f, 2.0f, 500, 1.0f, 0.85f, true},
      {"a ceiling unseen: at full speed at once", 1.2f, 1.2f, 2.0f, 0, 1.0f, 0.9f, true},
      {"a ceiling unseen, none known", 1.2f, 0.9f, NAN, 500, 1.0f, 0.85f, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const guard_t g = {.hold_z_m = row[i].hold_m, .retreat_ms = row[i].retreat_ms, .unseen = row[i].unseen};
    CHECK_NEAR(guard_retreat_z_m(&g, &p, row[i].z_m, row[i].ceiling_m, row[i].kp_per_s), row[i].want_m, 1e-6);
  }
}
