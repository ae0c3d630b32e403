// test_by_hand.c - the keep-out where the height is flown by hand: the law's own edges, and flights.
#include "flight/by_hand.h"
#include "rig/flying_app.h"
#include "rig/test.h"

static const by_hand_param_t PARAM = {
    .kp_per_s = 1.0f, .gap_min_m = 0.02f, .up_offset_m = 0.0f, .floor_m = 0.043f, .weight_N = 0.3f};

static by_hand_in_t in_of(float range_m, float thrust_N, float climb_mps) {
  return (by_hand_in_t){.period_s = 0.001f,
                        .thrust_N = thrust_N,
                        .climb_mps = climb_mps,
                        .q_wb = {.w = 1.0f},
                        .range_new = true,
                        .range_m = range_m};
}

TEST(by_hand_takes_the_stick_for_a_climb_where_the_room_is_less_than_it_takes_to_stop) {
  static const struct {
    const char *what;
    float range_m, thrust_N, climb_mps;
    bool want;
    float want_mps;
  } row[] = {
      {"at rest, near", 0.399f, 0.3f, 0.0f, true, 0.0f}, // 0.3 m of room and 0.1 m kept
      {"at rest, far enough", 0.401f, 0.3f, 0.0f, false, 0.0f},
      {"sinking", 0.401f, 0.3f, -1.0f, false, 0.0f},
      {"rising at 1 m/s, near", 0.899f, 0.3f, 1.0f, true, 0.0f}, // 0.4 m to react, 0.1 m to brake
      {"rising at 1 m/s, far enough", 0.901f, 0.3f, 1.0f, false, 0.0f},
      {"no thrust", 0.2f, 0.0f, 0.0f, false, 0.0f},
      {"more thrust than the room allows", 0.3f, 0.45f, 0.0f, true, 0.2f},
      {"less than the room allows", 0.3f, 0.315f, 0.0f, true, 0.1f},
      {"sinks by the stick", 0.3f, 0.24f, 0.0f, true, -0.4f},
      {"too near", 0.06f, 0.45f, 0.0f, true, -0.04f},
      {"at least", 0.3f, 0.0001f, 0.0f, true, -2.0f},
      {"below the sensor's floor", 0.042f, 0.45f, 0.0f, false, 0.0f},
      {"nothing above", 32.767f, 0.45f, 0.0f, false, 0.0f},
      {"at the sensor's end", 4.01f, 0.45f, 10.0f, false, 0.0f},
      {"no number", (float)NAN, 0.45f, 0.0f, false, 0.0f},
      {"a climb that is none", 0.3f, 0.3f, (float)NAN, true, 0.0f},
      {"a climb beyond all bounds", 0.9f, 0.3f, 21.0f, false, 0.0f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    by_hand_t s;
    by_hand_init(&s);
    float climb_mps = 9.0f;
    const by_hand_in_t in = in_of(row[i].range_m, row[i].thrust_N, row[i].climb_mps);
    CHECK(by_hand_step(&s, &PARAM, &in, &climb_mps) == row[i].want);
    CHECK(s.held == row[i].want);
    if (row[i].want) CHECK_NEAR(climb_mps, row[i].want_mps, 0.0011);
  }
}

TEST(by_hand_knows_where_the_ceiling_is_between_samples_and_for_half_a_second) {
  by_hand_t s;
  by_hand_init(&s);
  float climb_mps;
  by_hand_in_t in = in_of(1.0f, 0.3f, 0.2f);
  in.range_age_s = 0.1f;
  CHECK(!by_hand_step(&s, &PARAM, &in, &climb_mps));
  CHECK_NEAR(s.gap_m, 0.98, 1e-6);
  in.range_new = false;
  for (int ms = 0; ms < 498; ms++) (void)by_hand_step(&s, &PARAM, &in, &climb_mps);
  CHECK_NEAR(s.gap_m, 0.98 - 0.498 * 0.2, 1e-4);
  CHECK(s.since_s < BY_HAND_BELIEVE_S);
  for (int ms = 0; ms < 10; ms++) (void)by_hand_step(&s, &PARAM, &in, &climb_mps);
  CHECK(s.since_s == BY_HAND_BELIEVE_S);
  const float gap_m = s.gap_m; // and nothing runs away after it
  for (int ms = 0; ms < 10; ms++) (void)by_hand_step(&s, &PARAM, &in, &climb_mps);
  CHECK(s.gap_m == gap_m && !s.held);
}

TEST(by_hand_believes_no_gap_of_an_age_that_is_none) {
  static const struct {
    const char *what;
    float climb_mps, age_s;
    bool kept;
  } row[] = {
      {"infinite age, at rest", 0.0f, INFINITY, true}, // left a gap that was no number
      {"infinite age", 0.2f, INFINITY, true},
      {"an age that is no number", 0.2f, NAN, true},
      {"an age of minus an hour", 0.2f, -3600.0f, true},
      {"a gap of 7.9 m", 1.0f, -6.9f, false},
      {"a gap of 8.1 m", 1.0f, -7.1f, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    by_hand_t s;
    by_hand_init(&s);
    float climb_mps;
    by_hand_in_t in = in_of(0.5f, 0.3f, 0.0f);
    (void)by_hand_step(&s, &PARAM, &in, &climb_mps);
    in = in_of(1.0f, 0.3f, row[i].climb_mps);
    in.range_age_s = row[i].age_s;
    (void)by_hand_step(&s, &PARAM, &in, &climb_mps);
    CHECK((s.gap_m < 0.6f) == row[i].kept);
  }
}

TEST(by_hand_leaves_the_ceiling_farther_away_than_it_met_it_and_minds_tilt_and_offset) {
  by_hand_t s;
  by_hand_init(&s);
  float climb_mps;
  by_hand_in_t in = in_of(0.39f, 0.3f, 0.0f);
  CHECK(by_hand_step(&s, &PARAM, &in, &climb_mps));
  in.range_m = 0.499f;
  CHECK(by_hand_step(&s, &PARAM, &in, &climb_mps));
  in.range_m = 0.501f;
  CHECK(!by_hand_step(&s, &PARAM, &in, &climb_mps));
  in.range_m = 0.499f;
  CHECK(!by_hand_step(&s, &PARAM, &in, &climb_mps));
  by_hand_param_t above = PARAM;
  above.up_offset_m = 0.05f;
  (void)by_hand_step(&s, &above, &in, &climb_mps);
  CHECK_NEAR(s.gap_m, 0.449, 1e-6);
  in.q_wb = (quat_t){.w = 0.9659258f, .x = 0.2588190f}; // 30 degrees about x
  (void)by_hand_step(&s, &PARAM, &in, &climb_mps);
  CHECK_NEAR(s.gap_m, 0.499 * 0.8660254, 1e-5);
  in.q_wb = (quat_t){.w = 0.9238795f, .y = 0.3826834f}; // 45 about y
  (void)by_hand_step(&s, &PARAM, &in, &climb_mps);
  CHECK_NEAR(s.gap_m, 0.499 * 0.7071068, 1e-5);
  in.q_wb = (quat_t){.w = 0.9063078f, .y = 0.4226183f}; // 50: a wall
  in.range_m = 0.1f;
  (void)by_hand_step(&s, &PARAM, &in, &climb_mps);
  CHECK_NEAR(s.gap_m, 0.499 * 0.7071068, 1e-5);
}

// --- flights ----------------------------------------------------------------------------------------------

#define CEILING_M 2.5

typedef struct {
  flying_t f;
  double thrust; // of the weight, by hand
  bool blind;    // nobody looks up
  double nearest_m;
  int held_ms;
} flown_t;

// The range as the multiranger gives it: every 100 ms, 80 ms old, whole millimetres, and none below 4 cm.
static void fly(flown_t *w, int duration_ms) {
  static double seen_m[100];
  flying_t *const f = &w->f;
  for (int ms = 0; ms < duration_ms; ms++) {
    f->set.thrust_N = w->thrust * 9.81 * f->rig.param.mass_kg;
    pilot_in_t in = rig6_sense(&f->rig, &f->set);
    const double gap_m = CEILING_M - f->rig.pos_w_m.z;
    seen_m[ms % 100] = gap_m;
    in.range_new = ms % 100 == 99 && !w->blind;
    in.range_m = seen_m[19] > 4.0 ? (double)NAN : fmax(seen_m[19], 0.04);
    double motor_N[PILOT_MOTORS];
    crazyflie_ms(&f->vehicle, &in, motor_N);
    rig6_step(&f->rig, motor_N);
    w->nearest_m = fmin(w->nearest_m, gap_m);
    w->held_ms += f->vehicle.app.flight.by_hand.held;
  }
}

static void start(flown_t *w, double gap_m, double thrust) {
  app_start(&w->f);
  rig6_param_t body = w->f.rig.param;
  body.ceiling_m = CEILING_M;
  body.radius_m = 0.0231;
  w->f.rig = rig6_at(&body, d3(0.0, 0.0, CEILING_M - gap_m), 0.0, true);
  w->f.set = rig6_hold(d3(0.0, 0.0, 0.0), 0.0);
  for (int i = 0; i < 3; i++) w->f.set.mode[i] = PILOT_OFF;
  w->thrust = thrust;
  w->blind = false;
  w->nearest_m = HUGE_VAL;
  w->held_ms = 0;
}

TEST(by_hand_no_thrust_drives_it_into_the_ceiling_and_less_lets_it_go_again) {
  static const double gap_m[] = {0.3, 0.9, 1.6, 2.4}, thrust[] = {1.06, 1.2, 1.45};
  for (unsigned i = 0; i < sizeof gap_m / sizeof *gap_m; i++) {
    for (unsigned k = 0; k < sizeof thrust / sizeof *thrust; k++) {
      static flown_t w;
      start(&w, gap_m[i], thrust[k]);
      fly(&w, 10000);
      ROW("from %g m with %g of the weight: nearest %.3f m, held for %d ms", gap_m[i], thrust[k], w.nearest_m,
          w.held_ms);
      CHECK(w.nearest_m > 0.06);
      CHECK(w.held_ms > 1000);
      const double gap_end_m = CEILING_M - w.f.rig.pos_w_m.z;
      CHECK(gap_end_m > 0.08 && gap_end_m < 0.2); // it hovers there: ceil.min and the room
      CHECK(app_log(&w.f, "guard.action") == 0.0);
      w.thrust = 0.97;
      fly(&w, 12000);
      CHECK(CEILING_M - w.f.rig.pos_w_m.z > 0.45 && !w.f.vehicle.app.flight.by_hand.held);
    }
  }
}

TEST(by_hand_without_a_sensor_thrust_is_thrust) {
  static flown_t w;
  start(&w, 1.0, 1.25);
  w.blind = true;
  fly(&w, 2500);
  CHECK(w.held_ms == 0 && w.nearest_m < 0.02);
}

TEST(by_hand_no_thrust_at_all_stops_the_motors_under_a_ceiling_too) {
  static flown_t w;
  start(&w, 0.3, 1.0);
  fly(&w, 1000);
  CHECK(w.held_ms > 0);
  w.thrust = 0.0;
  fly(&w, 50);
  CHECK(app_log(&w.f, "indi.m1") == 0.0 && !w.f.vehicle.app.flight.by_hand.held);
}

// Stick closed and opened again where it hovers: nearer than guard.takeOff.
TEST(by_hand_a_stick_that_is_closed_and_opened_again_catches_it) {
  static flown_t w;
  start(&w, 0.3, 1.45);
  CHECK(crazyflie_set(&w.f.vehicle, "guard.takeOff", 0.2));
  fly(&w, 6000);
  CHECK(CEILING_M - w.f.rig.pos_w_m.z < 0.12);
  w.thrust = 0.0;
  fly(&w, 60);
  w.thrust = 1.45;
  fly(&w, 30);
  CHECK(app_log(&w.f, "guard.action") == 0.0 && app_log(&w.f, "indi.m1") > 0.0);
  fly(&w, 3000);
  CHECK(app_log(&w.f, "guard.action") == 0.0);
  CHECK(CEILING_M - w.f.rig.pos_w_m.z < 0.3 && w.nearest_m > 0.06);
}

TEST(by_hand_a_sensor_that_never_began_is_no_ceiling) {
  by_hand_param_t param = PARAM;
  param.floor_m = 0.0f;
  by_hand_t s;
  by_hand_init(&s);
  float climb_mps;
  by_hand_in_t in = in_of(0.0f, 0.45f, 0.0f);
  CHECK(!by_hand_step(&s, &param, &in, &climb_mps));
  in.range_m = 0.01f;
  CHECK(by_hand_step(&s, &param, &in, &climb_mps));
}
