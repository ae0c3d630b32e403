// test_ground.c - the thrust ratio over the ground: learned, flown by, and told from the ceiling's.
#include "flight/flight.h"
#include "rig/rig3.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

static const learn_param_t P = {.rls = {.form = RLS_RANDOM_WALK, .lambda = 1.0f, .p0 = 10.0f, .q = 1e-6f},
                                .near_m = 0.005f,
                                .far_m = 0.1f,
                                .blind_max_s = 3.0f,
                                .up_min = 0.97f,
                                .thrust_min = 0.3f,
                                .settle_s = 0.2f,
                                .y_max = 2.5f};
static const curve_param_t LIVE = {
    .mode = CURVE_LIVE, .on_m = 0.1f, .clip = 1, .ratio_min = 0.5f, .ratio_max = 2.0f, .fixed = {{1.0f}}};
static const lpf2_coef_t PLAIN = {.b0 = 1.0f}; // no filter

static float floor_ratio(float h_m) {
  return 1.0f + 0.15f * (float)exp(-33.0 * (double)h_m);
}

static learn_sample_t sample_of(float ratio) {
  return (learn_sample_t){
      .up = 1.0f, .force_N = 0.314f, .thrust_N = 0.314f / ratio, .weight_N = 0.314f, .since_limit_s = 5.0f};
}

static ground_t fresh(void) {
  ground_t g;
  memset(&g, 0x55, sizeof g);
  CHECK_OK(ground_init(&g, &P, &LIVE.fixed));
  return g;
}

// n samples at this height: how many were learned from.
static unsigned teach(ground_t *g, const curve_param_t *c, const ground_in_t *in, int n) {
  const unsigned before = g->learn.rls.count;
  for (int k = 0; k < n; k++) {
    ground_step(g, c, &P, &PLAIN, in);
    if (g->turn) CHECK_OK(ground_learn(g, &P));
  }
  return g->learn.rls.count - before;
}

TEST(ground_learns_the_floors_share_whatever_the_ceiling_adds) {
  static const float excess[] = {0.0f, 0.1f, 0.3f}, h_m[] = {0.09f, 0.06f, 0.03f, 0.015f};
  for (int i = 0; i < 3; i++) {
    ground_t g = fresh();
    for (int k = 0; k < 4; k++) {
      const learn_sample_t x = sample_of(floor_ratio(h_m[k]) + excess[i]);
      const ground_in_t in = {.height_m = h_m[k], .sample = &x, .excess = excess[i]};
      CHECK(teach(&g, &LIVE, &in, 400) == 400);
      CHECK_NEAR(g.at.ratio, floor_ratio(h_m[k]), 3e-3);
      CHECK_NEAR(g.lesson_excess, g.at.ratio - 1.0f, 1e-6);
    }
    for (int k = 0; k < 4; k++) {
      ROW("%g m, the ceiling adds %g", (double)h_m[k], (double)excess[i]);
      CHECK_NEAR(rbf_at(&g.learn.rls.theta, h_m[k]).ratio, floor_ratio(h_m[k]), 3e-3);
    }
  }
}

TEST(ground_takes_turns_with_the_ceilings_learner_where_both_are_near) {
  static const struct {
    const char *what;
    float h_m;
    bool shared;
    unsigned taught; // of ten samples
  } row[] = {{"over the floor alone", 0.03f, false, 10},
             {"in a channel", 0.03f, true, 5},
             {"under a ceiling alone", 0.3f, true, 0}};
  for (int i = 0; i < 3; i++) {
    ROW("%s", row[i].what);
    ground_t g = fresh();
    const learn_sample_t x = sample_of(1.05f);
    const ground_in_t in = {.height_m = row[i].h_m, .sample = &x, .shared = row[i].shared};
    CHECK(teach(&g, &LIVE, &in, 10) == row[i].taught);
  }
}

TEST(ground_learns_nothing_without_a_sample_in_another_mode_or_beyond_its_reach) {
  static const struct {
    const char *what;
    int32_t mode;
    bool sample;
    float h_m;
  } row[] = {{"no sample", CURVE_LIVE, false, 0.03f},
             {"fixed weights", CURVE_FIXED, true, 0.03f},
             {"theory", CURVE_THEORY, true, 0.03f},
             {"too high", CURVE_LIVE, true, 0.101f},
             {"standing", CURVE_LIVE, true, 0.004f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ground_t g = fresh();
    const learn_sample_t x = sample_of(1.1f);
    curve_param_t c = LIVE;
    c.mode = row[i].mode;
    const ground_in_t in = {.height_m = row[i].h_m, .sample = row[i].sample ? &x : NULL};
    CHECK(teach(&g, &c, &in, 10) == 0 && !g.turn);
    CHECK_OK(ground_learn(&g, &P));
    CHECK(memcmp(&g.learn.rls.theta, &LIVE.fixed, sizeof LIVE.fixed) == 0);
  }
}

TEST(ground_filters_the_height_as_all_signals_are_and_starts_afresh_after_a_rest) {
  lpf2_coef_t filter;
  CHECK_OK(lpf2_tune(&filter, 5.0f, 100.0f));
  ground_t g = fresh();
  const learn_sample_t x = sample_of(1.1f);
  ground_in_t in = {.height_m = 0.3f, .sample = &x};
  for (int k = 0; k < 5; k++) ground_step(&g, &LIVE, &P, &filter, &in);
  in.height_m = 0.03f; // where the filtered height still is far
  ground_step(&g, &LIVE, &P, &filter, &in);
  CHECK(!g.turn && g.height_m == 0.03f);
  ground_rest(&g);
  CHECK(!g.known);
  ground_step(&g, &LIVE, &P, &filter, &in);
  CHECK(g.turn && g.known);
  CHECK_NEAR(g.sample.zc_m, 0.03, 1e-6);
}

// --- in flight
// ----------------------------------------------------------------------------------------------

// At rest where it was told to be, but for a climb.
static outer_in_t climbing(float climb_mps) {
  return (outer_in_t){.pos_w_m = {0, 0, 0.05f},
                      .vel_w_mps = {0, 0, climb_mps},
                      .acc_b_mps2 = {0, 0, GRAVITY_MPS2},
                      .q_wb = {.w = 1.0f},
                      .thrust_N = 0.3f,
                      .setpoint = {.pos_w_m = {0, 0, 0.05f}, .vel_w_mps = {0, 0, climb_mps}}};
}

TEST(outer_adds_the_thrust_that_a_climb_out_of_the_ground_effect_will_lose) {
  flight_param_t p = rig3_param();
  for (float climb_mps = -0.2f; climb_mps <= 0.2f; climb_mps += 0.1f) {
    ROW("climb %g m/s", (double)climb_mps);
    float thrust_N[2];
    for (int pulls = 0; pulls < 2; pulls++) {
      outer_t f = rig3_outer(&p);
      f.ground.pull_per_s2 = pulls ? 30.0f : 0.0f;
      const outer_in_t in = climbing(climb_mps);
      thrust_N[pulls] = outer_step(&f, &in)->thrust_N;
    }
    const outer_t f = rig3_outer(&p);
    const float want_N = f.law.quick * p.pos.mass_kg * 30.0f * f.lag_s * climb_mps;
    CHECK_NEAR(thrust_N[1] - thrust_N[0], want_N, 1e-5);
  }
}

TEST(outer_flies_by_the_sum_of_what_both_surfaces_give) {
  flight_param_t p = rig3_param();
  outer_t f = rig3_outer(&p);
  f.ground.excess = 0.1f;
  const outer_in_t in = climbing(0.0f);
  CHECK(outer_step(&f, &in)->at.ratio == 1.1f); // no ceiling in sight
}

typedef struct {
  flight_t f;
  flight_param_t p;
  flight_in_t in;
  float floor_m; // where the feet would stand
} over_floor_t;

static void begin(over_floor_t *o, int32_t mode) {
  memset(o, 0, sizeof *o);
  params_default(&o->p);
  o->p.ground.mode = mode;
}

static void take_off(over_floor_t *o, float h_m) {
  CHECK_OK(flight_init(&o->f, &o->p));
  o->in = (flight_in_t){.q_wb = {.w = 1.0f}, .acc_b_mps2 = {0, 0, GRAVITY_MPS2}};
  o->in.pos_w_m.z = o->floor_m + h_m;
  o->in.setpoint = (flight_setpoint_t){.x = AXIS_POSITION, .y = AXIS_POSITION, .z = AXIS_POSITION};
  o->in.setpoint.pos_w_m = o->in.pos_w_m;
}

// A hover at this height, its thrust that over a floor; a call every so many milliseconds.
static void hover(over_floor_t *o, float h_m, int calls, uint32_t every_ms) {
  for (int i = 0; i < MOTORS; i++)
    o->in.force_N[i] = 0.25f * o->p.pos.mass_kg * GRAVITY_MPS2 / floor_ratio(h_m);
  for (int k = 0; k < calls; k++) {
    o->in.step += every_ms;
    o->in.rate_b_radps.x = 1e-3f * (float)(k % 3); // a gyro lives
    o->in.acc_b_mps2.x = 1e-3f * (float)(k % 5);
    (void)flight_step(&o->f, &o->in);
  }
}

TEST(flight_learns_over_the_ground_and_flies_by_it_where_it_is_told_to) {
  static const struct {
    int32_t mode;
    float zero_m;
    bool flies, learns;
  } row[] = {{CURVE_OFF, 0.0f, false, false},
             {CURVE_LIVE, 0.0f, true, true},
             {CURVE_LIVE, 0.4f, true, true},
             {CURVE_FIXED, 0.0f, true, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("mode %d, zero %g m", (int)row[i].mode, (double)row[i].zero_m);
    static over_floor_t o;
    begin(&o, row[i].mode);
    o.floor_m = o.p.ground_zero_m = row[i].zero_m;
    if (row[i].mode == CURVE_FIXED)
      o.p.ground.fixed = (rbf_weights_t){{1.0f, 0, 0, 0, floor_ratio(0.03f) - 1.0f}};
    take_off(&o, 0.03f);
    hover(&o, 0.03f, 6000, 1);
    CHECK_NEAR(o.f.outer.ground.excess, row[i].flies ? floor_ratio(0.03f) - 1.0f : 0.0f, 2e-3);
    CHECK_NEAR(o.f.out.outer.at.ratio - 1.0f, o.f.outer.ground.excess, 1e-4);
    CHECK((o.f.ground.learn.rls.count > 400) == row[i].learns);
    CHECK(o.f.ground.known == row[i].flies);
    o.f.outer.param.ground.mode = CURVE_OFF;
    o.f.outer.ground.excess = 2.0f; // a flipped bit
    hover(&o, 0.03f, 10, 1);
    CHECK(o.f.outer.ground.excess == 0.0f && o.f.outer.ground.pull_per_s2 == 0.0f);
  }
}

TEST(flight_foretells_a_climb_out_of_the_ground_effect_as_a_hover_loses_it) {
  static over_floor_t o;
  begin(&o, CURVE_THEORY);
  take_off(&o, 0.03f);
  hover(&o, 0.03f, 100, 1);
  const float excess = o.p.ground.ca * (float)exp(-(double)o.p.ground.cb_per_m * 0.03);
  const float want_per_s2 = GRAVITY_MPS2 * o.p.ground.cb_per_m * excess / (1.0f + excess);
  CHECK_NEAR(o.f.outer.ground.pull_per_s2, want_per_s2, 0.02);
}

TEST(flight_takes_a_jump_of_the_height_for_a_table_that_it_flies_over) {
  static over_floor_t o;
  begin(&o, CURVE_THEORY);
  take_off(&o, 0.5f);
  hover(&o, 0.5f, 100, 1);
  CHECK(o.f.outer.ground.excess == 0.0f);
  o.in.pos_w_m.z = 0.03f;
  hover(&o, 0.03f, 20, 1);
  CHECK_NEAR(o.f.ground.height_m, 0.03, 1e-3);
  CHECK(o.f.outer.ground.excess > 0.05f);
}

TEST(flight_learns_nothing_over_the_ground_before_it_carries_and_from_a_floor_that_carries) {
  static const struct {
    const char *what;
    float after_s, thrust; // of what hovers there
    bool no_lesson, learns;
  } row[] = {{"hovers", 1.0f, 1.0f, false, true},
             {"has just taken off", 10.0f, 1.0f, false, false},
             {"stands, its rotors at 45 %", 1.0f, 0.45f, false, false},
             {"may not learn", 1.0f, 1.0f, true, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    static over_floor_t o;
    begin(&o, CURVE_LIVE);
    o.p.learn_after_s = row[i].after_s;
    take_off(&o, 0.03f);
    o.in.no_lesson = row[i].no_lesson;
    o.p.pos.mass_kg *= row[i].thrust; // of hover() alone: the controller knows the whole one
    hover(&o, 0.03f, 4000, 1);
    CHECK((o.f.ground.learn.rls.count > 0) == row[i].learns);
  }
}

TEST(flight_forgets_the_grounds_share_where_calls_are_late_and_teaches_the_ceiling_nothing_then) {
  static over_floor_t o;
  begin(&o, CURVE_THEORY);
  take_off(&o, 0.03f);
  hover(&o, 0.03f, 100, 1);
  CHECK(o.f.outer.ground.excess > 0.05f);
  hover(&o, 0.03f, 100, 3);
  CHECK(o.f.outer.ground.excess == 0.0f && o.f.outer.ground.lesson_excess == 0.0f && !o.f.ground.known);
  CHECK(o.f.outer.started);
  hover(&o, 0.03f, 40, 1);
  CHECK(o.f.outer.ground.excess > 0.05f && o.f.ground.known);
}

TEST(flight_bounds_what_the_grounds_curve_does_whatever_its_weights_are) {
  static const float weight[] = {-5.0f, 5.0f};
  for (int first = 0; first < 2; first++)
    for (int bell = 0; bell < 2; bell++) {
      ROW("constant %g, bells %g", (double)weight[first], (double)weight[bell]);
      static over_floor_t o;
      begin(&o, CURVE_FIXED);
      o.p.ground.clip = 0;
      o.p.ground.ratio_min = 0.1f;
      o.p.ground.ratio_max = 5.0f;
      for (int i = 0; i < RBF_N; i++) o.p.ground.fixed.w[i] = i == 0 ? weight[first] : weight[bell];
      take_off(&o, 0.03f);
      for (float h_m = 0.005f; h_m < 0.1f; h_m += 0.01f) {
        o.in.pos_w_m.z = h_m;
        hover(&o, h_m, 10, 1);
        const outer_t *const f = &o.f.outer;
        CHECK(f->ground.excess >= GROUND_LEAST && f->ground.excess <= 4.0f);
        CHECK(fabsf(f->ground.pull_per_s2) * f->lag_s <= GROUND_DAMPING * f->law.kd_z_per_s * 1.0001f);
      }
    }
}

TEST(flight_divides_by_no_ratio_below_zero_where_both_curves_say_the_least) {
  static over_floor_t o;
  begin(&o, CURVE_FIXED);
  o.p.curve.clip = o.p.ground.clip = 0;
  o.p.curve.ratio_min = o.p.ground.ratio_min = 0.1f;
  o.p.curve.fixed = o.p.ground.fixed = (rbf_weights_t){{-5.0f}};
  take_off(&o, 0.03f);
  hover(&o, 0.03f, 100, 1);
  o.f.outer.ceiling.known = true;
  o.f.outer.ceiling.zc_m = 0.06f;
  hover(&o, 0.03f, 10, 1);
  CHECK_NEAR(o.f.out.outer.at.ratio, 0.1f + GROUND_LEAST, 1e-6);
  CHECK(o.f.out.outer.at.ratio > 0.0f && f_finite(o.f.out.outer.thrust_N));
}
