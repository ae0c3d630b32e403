// test_app_params.c - the parameters of the app: written one by one at any time, flown as a whole.
#include "rig/flying_app.h"
#include "rig/test.h"

#include <string.h>

TEST(app_has_every_parameter_of_the_table_with_its_default_type_and_place) {
  static crazyflie_t c;
  crazyflie_init(&c, NULL);
  for (int i = 0; i < params_count; i++) {
    const param_row_t *row = &params_table[i];
    ROW("%s", row->name);
    double value = (double)NAN;
    CHECK(strlen(row->name) + 1 <= 26);
    CHECK(crazyflie_param(&c, row->name, &value));
    CHECK((float)value == row->initial);
    const float other = value == (double)row->max ? row->min : row->max;
    CHECK(crazyflie_set(&c, row->name, (double)other));
    CHECK(params_get(&c.app.tuned, row) == other);
    CHECK(params_get(&glue_static.tuned, row) == row->initial); // another vehicle keeps its own
  }
}

TEST(app_flies_on_to_the_bit_whatever_is_written_into_its_parameters) {
  static const struct {
    const char *name;
    double value;
  } bad[] = {{"indiPos.kp", 1e9},      {"indiPos.kd", -5.0},
             {"indiPos.cutoff", 60.0}, {"indiAtt.kp", (double)NAN},
             {"indiAtt.cutoff", -1.0}, {"ceil.mode", 7.0},
             {"rls.p0", 0.0},          {"rls.zMin", 0.1},
             {"indiPos.mass", 0.0},    {"ceil.near", HUGE_VAL},
             {"guard.share", 2.0},     {"indiPos.cutoff", 0.01}};
  static flying_t alone, poked;
  app_start(&alone);
  app_start(&poked);
  app_fly(&alone, 500);
  app_fly(&poked, 500);
  const int n = (int)(sizeof bad / sizeof *bad);
  for (int i = 0; i < n; i++) {
    ROW("%s = %g", bad[i].name, bad[i].value);
    double before, after;
    CHECK(crazyflie_param(&poked.vehicle, bad[i].name, &before));
    CHECK(crazyflie_set(&poked.vehicle, bad[i].name, bad[i].value));
    app_fly(&alone, 7);
    app_fly(&poked, 7);
    CHECK(memcmp(&alone.rig, &poked.rig, sizeof alone.rig) == 0);
    CHECK(memcmp(&alone.vehicle.app.flight, &poked.vehicle.app.flight, sizeof(flight_t)) == 0);
    CHECK(app_log(&poked, "ceil.noSet") == i + 1);
    CHECK(crazyflie_param(&poked.vehicle, bad[i].name, &after));
    // Out of its range: the old value is back. In range, but against another one: it waits, so put it back.
    const bool in_range = strcmp(bad[i].name, "rls.zMin") == 0 || i == n - 1;
    CHECK(in_range || after == before);
    if (in_range) CHECK(crazyflie_set(&poked.vehicle, bad[i].name, before));
  }
}

static void check_same(const flying_t *a, const flying_t *b) {
  CHECK(memcmp(&a->rig, &b->rig, sizeof a->rig) == 0);
  CHECK(memcmp(&a->vehicle.app.flight, &b->vehicle.app.flight, sizeof(flight_t)) == 0);
}

TEST(app_counts_and_puts_back_whatever_is_beyond_a_parameters_range) {
  static flying_t alone, poked;
  app_start(&alone);
  app_start(&poked);
  int refused = 0;
  for (int i = 0; i < params_count; i++) {
    const param_row_t *row = &params_table[i];
    const bool whole = row->type == PARAM_INT;
    const double odd[] = {(double)row->max * 1.01 + 1.0, (double)row->min - 1.0, whole ? 1e9 : (double)NAN,
                          whole ? -1e9 : HUGE_VAL, whole ? 77.0 : -HUGE_VAL};
    for (unsigned k = 0; k < sizeof odd / sizeof *odd; k++) {
      ROW("%s = %g", row->name, odd[k]);
      CHECK(crazyflie_set(&poked.vehicle, row->name, odd[k]));
      if (strncmp(strchr(row->name, '.'), ".w", 2) == 0 && strlen(strchr(row->name, '.')) == 3)
        CHECK(crazyflie_set(&poked.vehicle, "ceil.commit", COMMIT_TYPED));
      app_fly(&alone, 3);
      app_fly(&poked, 3);
      check_same(&alone, &poked);
      CHECK(app_log(&poked, "ceil.noSet") == ++refused);
      CHECK(params_get(&poked.vehicle.app.tuned, row) == params_get(&alone.vehicle.app.tuned, row));
    }
  }
}

TEST(app_flies_on_while_a_parameter_is_half_written) {
  static flying_t alone, poked;
  app_start(&alone);
  app_start(&poked);
  for (int i = 0; i < params_count; i++) {
    ROW("%s", params_table[i].name);
    unsigned char *const at = (unsigned char *)&poked.vehicle.app.tuned + params_table[i].offset;
    unsigned char before[4];
    memcpy(before, at, 4);
    memset(at + 2, 0x7f, 2); // and the parameter task was interrupted: it has not said that it is done
    app_fly(&alone, 3);
    app_fly(&poked, 3);
    check_same(&alone, &poked);
    memcpy(at, before, 4);
  }
  CHECK(app_log(&poked, "ceil.noSet") == 0.0);
}

TEST(app_flies_a_set_from_the_next_tick_on_even_where_a_write_interrupts_one) {
  static flying_t f;
  app_start(&f);
  app_fly(&f, 10);
  // Between the judgement of one write and its tick comes another one, which is refused: the first one flies.
  CHECK(crazyflie_set(&f.vehicle, "indiPos.kp", 2.0));
  CHECK(crazyflie_set(&f.vehicle, "indiPos.kd", -1.0));
  app_fly(&f, 4);
  CHECK(app_log(&f, "ceil.noSet") == 1.0);
  CHECK(f.vehicle.app.flight.outer.param.pos.kp_per_s == 2.0f); // what reads back is what flies
  CHECK(f.vehicle.app.flight.outer.param.pos.kd_per_s == 4.0f);
}

TEST(app_commits_nothing_that_was_not_judged_even_where_a_tick_comes_before_the_callback) {
  static flying_t f;
  app_start(&f);
  app_fly(&f, 10);
  CHECK(crazyflie_set(&f.vehicle, "ceil.w2", 0.25));
  f.vehicle.app.commit = COMMIT_TYPED; // and the parameter task was interrupted
  app_fly(&f, 4);
  CHECK(app_log(&f, "ceil.commits") == 0.0);
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  app_fly(&f, 6);
  CHECK(app_log(&f, "ceil.commits") == 1.0);
  CHECK(f.vehicle.app.tuned.curve.fixed.w[1] == 0.25f);
  CHECK(f.vehicle.app.flight.outer.param.curve.fixed.w[1] == 0.25f);
}

TEST(app_takes_weights_as_a_whole_and_only_when_told_to) {
  static flying_t f;
  app_start(&f);
  app_fly(&f, 100);
  const rbf_weights_t before = f.vehicle.app.flown.curve.fixed;
  char name[] = "ceil.w1";
  for (int i = 0; i < RBF_N; i++) {
    name[6] = (char)('1' + i);
    CHECK(crazyflie_set(&f.vehicle, name, i == 0 ? 1.0 : 0.01 * i));
    app_fly(&f, 1); // between two writes a tick
    CHECK(memcmp(&f.vehicle.app.flight.outer.param.curve.fixed, &before, sizeof before) == 0);
  }
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  app_fly(&f, 6);
  CHECK(f.vehicle.app.flight.outer.param.curve.fixed.w[0] == 1.0f);
  CHECK(f.vehicle.app.flight.outer.param.curve.fixed.w[6] == 0.06f);
  CHECK(f.vehicle.app.flight.outer.learn.rls.theta.w[6] == 0.06f); // learning goes on from there
  CHECK(app_log(&f, "ceil.commits") == 1.0);
  // One that is no number: none is taken.
  CHECK(crazyflie_set(&f.vehicle, "ceil.w2", 0.5));
  CHECK(crazyflie_set(&f.vehicle, "ceil.w3", (double)NAN));
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  app_fly(&f, 6);
  CHECK(f.vehicle.app.flight.outer.param.curve.fixed.w[1] == 0.01f);
  CHECK(app_log(&f, "ceil.noCommit") == 1.0);
  double commit = 9.0;
  CHECK(crazyflie_param(&f.vehicle, "ceil.commit", &commit) && commit == 0.0);
}

TEST(app_commits_learned_weights_but_not_while_it_learns) {
  static flying_t f;
  app_start(&f);
  CHECK(crazyflie_set(&f.vehicle, "ceil.mode", CURVE_LIVE));
  app_fly(&f, 100);
  CHECK(app_log(&f, "ceil.learning") == 1.0);
  f.vehicle.app.flight.outer.learn.rls.theta.w[3] = 0.123f;
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_LEARNED));
  app_fly(&f, 4);
  CHECK(app_log(&f, "ceil.noCommit") == 1.0 && f.vehicle.app.flown.curve.fixed.w[3] != 0.123f);
  CHECK(crazyflie_set(&f.vehicle, "ceil.mode", CURVE_FIXED));
  app_fly(&f, 2);
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_LEARNED));
  app_fly(&f, 4);
  double w4 = 0.0;
  CHECK(crazyflie_param(&f.vehicle, "ceil.w4", &w4)); // from here it can be stored
  CHECK((float)w4 == 0.123f && f.vehicle.app.flown.curve.fixed.w[3] == 0.123f);
}

TEST(app_refuses_a_commit_of_what_cannot_be_flown_and_takes_one_where_the_height_is_not_controlled) {
  static flying_t f;
  app_start(&f);
  app_fly(&f, 10);
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", 3)); // there is none
  app_fly(&f, 4);
  CHECK(app_log(&f, "ceil.noCommit") == 1.0 && app_log(&f, "ceil.commits") == 0.0);
  static const float odd[] = {NAN, HUGE_VALF, 5.5f, -5.5f};
  for (unsigned i = 0; i < sizeof odd / sizeof *odd; i++) {
    ROW("%g", (double)odd[i]);
    const rbf_weights_t before = f.vehicle.app.flown.curve.fixed;
    f.vehicle.app.flight.outer.learn.rls.theta.w[2] = odd[i];
    CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_LEARNED));
    app_fly(&f, 4);
    CHECK(app_log(&f, "ceil.noCommit") == 2.0 + i && app_log(&f, "ceil.commits") == 0.0);
    CHECK(memcmp(&f.vehicle.app.flown.curve.fixed, &before, sizeof before) == 0);
    CHECK(crazyflie_set(&f.vehicle, "indiPos.kp", 1.0 + 0.1 * i)); // and what comes after it is taken
    app_fly(&f, 4);
    CHECK(f.vehicle.app.flight.outer.param.pos.kp_per_s == 1.0f + 0.1f * (float)i);
  }
  f.vehicle.app.flight.outer.learn.rls.theta.w[2] = 0.5f;
  CHECK(crazyflie_set(&f.vehicle, "ceil.mode", CURVE_LIVE));
  f.set.mode[2] = PILOT_OFF;
  f.set.thrust_N = 9.81 * f.rig.param.mass_kg;
  app_fly(&f, 4);
  CHECK(app_log(&f, "ceil.learning") == 0.0);
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_LEARNED));
  app_fly(&f, 4);
  CHECK(app_log(&f, "ceil.commits") == 1.0);
}
