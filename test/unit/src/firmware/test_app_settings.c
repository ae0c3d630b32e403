// test_app_settings.c - in which call a written set or a commit is taken, and what is left of it then.
#include "rig/flying_app.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

static void start(flying_t *f) {
  app_start(f);
  app_fly(f, 40);
}

static float flown_kp(const flying_t *f) {
  return f->vehicle.app.flight.outer.param.pos.kp_per_s;
}

// --- a set ------------------------------------------------------------------------------------------------

TEST(app_takes_a_set_in_a_call_in_which_neither_the_outer_loop_nor_a_lesson_runs) {
  for (int at = 0; at < 10; at++) {
    ROW("written before millisecond %d of ten", at);
    static flying_t f;
    start(&f);
    const glue_t *const app = &f.vehicle.app;
    while ((app->flight.phase + 1) % 10 != (unsigned)at) app_fly(&f, 1);
    CHECK(crazyflie_set(&f.vehicle, "indiPos.kp", 2.0));
    app_fly(&f, 1);
    CHECK((flown_kp(&f) == 2.0f) == (at % 2 == 1));
    if (flown_kp(&f) == 2.0f) CHECK((app->flight.due & ~(unsigned)FLIGHT_INNER) == 0);
    app_fly(&f, 1);
    CHECK(flown_kp(&f) == 2.0f);
  }
}

TEST(app_takes_a_set_once) {
  static flying_t f;
  start(&f);
  const uint8_t before = f.vehicle.app.recorder.tunes;
  CHECK(crazyflie_set(&f.vehicle, "indiPos.kp", 2.0));
  CHECK(f.vehicle.app.ready);
  app_fly(&f, 20);
  CHECK(!f.vehicle.app.ready && f.vehicle.app.recorder.tunes == before + 1);
}

TEST(app_flies_nothing_of_a_set_that_contradicts_itself_until_it_is_mended) {
  static flying_t f;
  start(&f);
  CHECK(crazyflie_set(&f.vehicle, "indiPos.kp", 2.0));
  CHECK(crazyflie_set(&f.vehicle, "rls.zMin", 0.1)); // not below rls.zMax, before any tick
  app_fly(&f, 20);
  CHECK(flown_kp(&f) == 0.5f);
  CHECK(f.vehicle.app.flown.learn.near_m == 0.005f);
  CHECK(crazyflie_set(&f.vehicle, "rls.zMin", 0.006));
  app_fly(&f, 20);
  CHECK(flown_kp(&f) == 2.0f);
  CHECK(f.vehicle.app.flown.learn.near_m == 0.006f);
}

TEST(app_mends_a_flipped_bit_of_its_parameters_in_one_call_of_ten) {
  for (int at = 0; at < 10; at++) {
    ROW("millisecond %d of ten", at);
    static flying_t f;
    start(&f);
    flight_t *const flight = &f.vehicle.app.flight;
    while ((flight->phase + 1) % 10 != (unsigned)at) app_fly(&f, 1);
    flight->outer.param.pos.kp_per_s = 1.5f;
    app_fly(&f, 1);
    CHECK(flown_kp(&f) == (at == 8 ? 0.5f : 1.5f));
    CHECK(flight->due == FLIGHT_SCRUB || at != 8); // in that in which the flight code mends what is its own
    app_fly(&f, 9);
    CHECK(flown_kp(&f) == 0.5f);
  }
}

// --- a commit ---------------------------------------------------------------------------------------------

TEST(app_takes_a_commit_the_set_and_the_second_learners_start_each_in_a_call_of_its_own) {
  static flying_t f;
  start(&f);
  const glue_t *const app = &f.vehicle.app;
  CHECK(crazyflie_set(&f.vehicle, "indiPos.kp", 2.0));
  CHECK(crazyflie_set(&f.vehicle, "ceil.w2", 0.25));
  CHECK(crazyflie_set(&f.vehicle, "ground.w5", 0.125));
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  const uint8_t tunes = app->recorder.tunes;
  for (int ms = 0; app->commits == 0 && ms < 2; ms++) app_fly(&f, 1);
  CHECK(app->commits == 1 && app->commit == 0 && app->commit_asked == 0);
  CHECK(app->recorder.tunes == tunes + 1);
  CHECK(app->flown.curve.fixed.w[1] == 0.25f && app->flown.ground.fixed.w[4] == 0.125f);
  CHECK(app->flight.outer.learn.rls.theta.w[1] == 0.25f && app->flight.ground.learn.rls.theta.w[4] == 0.0f);
  app_fly(&f, 1);
  CHECK(flown_kp(&f) == 0.5f);
  app_fly(&f, 1);
  CHECK(flown_kp(&f) == 2.0f && app->flight.outer.param.curve.fixed.w[1] == 0.25f);
  CHECK(app->flight.outer.param.ground.fixed.w[4] == 0.125f);
  CHECK(app->flight.ground.learn.rls.theta.w[4] == 0.0f);
  app_fly(&f, 2);
  CHECK(app->flight.ground.learn.rls.theta.w[4] == 0.125f);
  app_fly(&f, 20);
  CHECK(app->commits == 1 && app->recorder.tunes == tunes + 2);
}

TEST(app_takes_sets_and_commits_and_mends_bits_however_late_calls_are) {
  for (uint32_t late_ms = 1; late_ms <= 12; late_ms++) {
    ROW("a call every %u ms", (unsigned)late_ms);
    static flying_t f;
    start(&f);
    glue_t *const app = &f.vehicle.app;
    CHECK(crazyflie_set(&f.vehicle, "indiPos.kp", 2.0));
    CHECK(crazyflie_set(&f.vehicle, "ground.w5", 0.125));
    CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
    for (int call = 0; call < 60; call++) {
      app_fly(&f, 1);
      f.rig.step += late_ms - 1;
      if (call == 30) app->flight.outer.param.pos.kd_per_s = 1.5f; // a flipped bit
    }
    CHECK(app->commits == 1 && app->flown.ground.fixed.w[4] == 0.125f);
    CHECK(app->flight.ground.learn.rls.theta.w[4] == 0.125f);
    CHECK(flown_kp(&f) == 2.0f && app->flight.outer.param.pos.kd_per_s == app->flown.pos.kd_per_s);
  }
}

TEST(app_commits_the_weights_of_both_curves_or_none) {
  for (int wrong = 0; wrong < 3; wrong++) {
    ROW("%s", wrong == 0 ? "both good" : wrong == 1 ? "the ceiling's no number" : "the ground's no number");
    static flying_t f;
    start(&f);
    glue_t *const app = &f.vehicle.app;
    const flight_param_t before = app->flown;
    app->flight.outer.learn.rls.theta.w[1] = wrong == 1 ? NAN : 0.25f;
    app->flight.ground.learn.rls.theta.w[1] = wrong == 2 ? NAN : 0.125f;
    CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_LEARNED));
    app_fly(&f, 20);
    CHECK(app->commits == (wrong == 0) && app->commits_refused == (wrong != 0));
    CHECK(app->flown.curve.fixed.w[1] == (wrong == 0 ? 0.25f : before.curve.fixed.w[1]));
    CHECK(app->flown.ground.fixed.w[1] == (wrong == 0 ? 0.125f : before.ground.fixed.w[1]));
    CHECK(memcmp(&app->tuned, &app->flown, sizeof app->flown) == 0);
  }
}

TEST(app_forgets_a_commit_that_is_refused_before_any_tick) {
  static flying_t f;
  start(&f);
  const glue_t *const app = &f.vehicle.app;
  CHECK(crazyflie_set(&f.vehicle, "ceil.w2", (double)NAN));
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  CHECK(app->commit == 0 && app->commits_refused == 1);
  app_fly(&f, 20);
  CHECK(app->commits == 0 && app->commits_refused == 1);
}

TEST(app_selected_anew_has_nothing_left_to_take) {
  static flying_t f;
  start(&f);
  CHECK(crazyflie_set(&f.vehicle, "indiPos.kp", 2.0));
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_LEARNED));
  crazyflie_start(&f.vehicle);
  const glue_t *const app = &f.vehicle.app;
  CHECK(!app->ready && app->commit == 0 && flown_kp(&f) == 2.0f);
  const uint8_t tunes = app->recorder.tunes;
  app_fly(&f, 20);
  CHECK(app->recorder.tunes == tunes && app->commits == 0 && app->commits_refused == 0);
}

// What a client stored is held against the sum that another build makes.
TEST(app_makes_the_sum_of_weights_that_it_always_made) {
  static const float weight[2][RBF_N] = {{1.1f, 0.2f, -0.1f, 0.0f, 0.1f, -0.2f, 0.3f},
                                         {1.0f, -0.2f, 0.1f, 0.4f, -0.1f, 0.2f, -0.3f}};
  uint32_t sum[2]; // of the table's weights both have the same part
  for (int k = 0; k < 2; k++) {
    static flying_t f;
    start(&f);
    memcpy(f.vehicle.app.tuned.curve.fixed.w, weight[k], sizeof weight[k]);
    CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
    app_fly(&f, 4);
    sum[k] = f.vehicle.app.weights_sum;
  }
  CHECK((sum[0] ^ sum[1]) == 0xa263282cu);
}
