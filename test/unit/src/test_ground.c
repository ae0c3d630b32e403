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

// What the curve says after n samples at this height.
static rbf_point_t teach(ground_t *g, float h_m, int n, float excess, bool shared) {
  rbf_point_t at = {.ratio = 0.0f};
  const learn_sample_t x = sample_of(floor_ratio(h_m) + excess);
  const ground_in_t in = {.height_m = h_m, .sample = &x, .excess = excess, .shared = shared};
  for (int k = 0; k < n; k++) CHECK_OK(ground_step(g, &LIVE, &P, &PLAIN, &in, &at));
  return at;
}

TEST(ground_learns_the_floors_share_whatever_the_ceiling_adds) {
  static const float excess[] = {0.0f, 0.1f, 0.3f}, h_m[] = {0.09f, 0.06f, 0.03f, 0.015f};
  for (int i = 0; i < 3; i++) {
    ground_t g = fresh();
    for (int k = 0; k < 4; k++) teach(&g, h_m[k], 400, excess[i], false);
    for (int k = 0; k < 4; k++) {
      ROW("%g m, the ceiling adds %g", (double)h_m[k], (double)excess[i]);
      CHECK_NEAR(rbf_at(&g.learn.rls.theta, h_m[k]).ratio, floor_ratio(h_m[k]), 3e-3);
    }
    CHECK(g.learn.rls.count == 1600);
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
    unsigned left = 0; // to the ceiling's
    for (int k = 0; k < 10; k++) {
      rbf_point_t at;
      left += !g.turn;
      (void)!ground_step(&g, &LIVE, &P, &PLAIN, &in, &at);
    }
    CHECK(g.learn.rls.count == row[i].taught);
    if (row[i].shared) CHECK(left == 10 - row[i].taught);
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
    rbf_point_t at;
    for (int k = 0; k < 10; k++) (void)!ground_step(&g, &c, &P, &PLAIN, &in, &at);
    CHECK(g.learn.rls.count == 0 && !g.turn);
    CHECK(memcmp(&g.learn.rls.theta, &LIVE.fixed, sizeof LIVE.fixed) == 0);
  }
}

TEST(ground_filters_the_height_as_all_signals_are_and_starts_afresh_after_a_rest) {
  lpf2_coef_t filter;
  CHECK_OK(lpf2_tune(&filter, 5.0f, 100.0f));
  ground_t g = fresh();
  rbf_point_t at;
  const learn_sample_t x = sample_of(1.1f);
  ground_in_t in = {.height_m = 0.3f, .sample = &x};
  for (int k = 0; k < 5; k++) (void)!ground_step(&g, &LIVE, &P, &filter, &in, &at);
  in.height_m = 0.03f; // where the filtered height still is far
  (void)!ground_step(&g, &LIVE, &P, &filter, &in, &at);
  CHECK(g.learn.rls.count == 0);
  ground_rest(&g);
  CHECK_OK(ground_step(&g, &LIVE, &P, &filter, &in, &at));
  CHECK(g.learn.rls.count == 1);
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

// Hovers at this height, its thrust that of a floor.
static void hover(flight_t *f, const flight_param_t *p, uint32_t *step, float h_m, int ms) {
  flight_in_t in = {.q_wb = {.w = 1.0f}, .acc_b_mps2 = {0, 0, GRAVITY_MPS2}, .pos_w_m = {0, 0, h_m}};
  in.setpoint =
      (flight_setpoint_t){.x = AXIS_POSITION, .y = AXIS_POSITION, .z = AXIS_POSITION, .pos_w_m = {0, 0, h_m}};
  for (int i = 0; i < MOTORS; i++)
    in.force_N[i] = 0.25f * p->pos.mass_kg * GRAVITY_MPS2 / floor_ratio(h_m - p->ground_zero_m);
  for (int k = 0; k < ms; k++) {
    in.step = ++*step;
    in.rate_b_radps.x = 1e-3f * (float)(k % 3); // a gyro lives
    in.acc_b_mps2.x = 1e-3f * (float)(k % 5);
    (void)flight_step(f, &in);
  }
}

TEST(flight_learns_over_the_ground_and_flies_by_it_where_it_is_told_to) {
  static const struct {
    int32_t mode;
    float zero_m;
    bool learns;
  } row[] = {{CURVE_OFF, 0.0f, false},
             {CURVE_LIVE, 0.0f, true},
             {CURVE_LIVE, 0.4f, true},
             {CURVE_FIXED, 0.0f, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("mode %d, zero %g m", (int)row[i].mode, (double)row[i].zero_m);
    flight_param_t p;
    params_default(&p);
    p.ground.mode = row[i].mode;
    p.ground_zero_m = row[i].zero_m;
    static flight_t f;
    CHECK_OK(flight_init(&f, &p));
    uint32_t step = 0;
    hover(&f, &p, &step, row[i].zero_m + 0.03f, 6000);
    const float floor = floor_ratio(0.03f) - 1.0f;
    CHECK_NEAR(f.outer.ground.excess, row[i].learns ? floor : 0.0f, 2e-3);
    CHECK((f.ground.learn.rls.count > 400) == row[i].learns);
    CHECK(f.ground.known == (row[i].mode != CURVE_OFF));
    f.outer.param.ground.mode = CURVE_OFF;
    f.outer.ground.excess = 2.0f; // a flipped bit
    hover(&f, &p, &step, row[i].zero_m + 0.03f, 10);
    CHECK(f.outer.ground.excess == 0.0f && f.outer.ground.pull_per_s2 == 0.0f);
  }
}

TEST(flight_leaves_a_thrust_ratio_to_divide_by_whatever_both_curves_say) {
  flight_param_t p;
  params_default(&p);
  p.curve.clip = p.ground.clip = 0;
  p.curve.ratio_min = p.ground.ratio_min = 0.1f;
  p.curve.fixed = p.ground.fixed = (rbf_weights_t){{-5.0f}};
  p.ground.mode = CURVE_FIXED;
  static flight_t f;
  CHECK_OK(flight_init(&f, &p));
  uint32_t step = 0;
  hover(&f, &p, &step, 0.03f, 100);
  CHECK(f.outer.ground.excess == -0.05f);
  CHECK(f.outer.ground.excess + p.curve.ratio_min > 0.0f && f_finite(f.out.outer.thrust_N));
}
