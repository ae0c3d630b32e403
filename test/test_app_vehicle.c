// test_app_vehicle.c - the app as it runs on the vehicle: parameters, commits, shadow flight, hand-overs,
// what it refuses.
#include "app.h"
#include "crazyflie/crazyflie.h"
#include "pilot_flight.h"
#include "rig6.h"
#include "test.h"

#include <setjmp.h>
#include <string.h>

typedef struct {
  crazyflie_t vehicle;
  rig6_t rig;
  pilot6_setpoint_t set;
} flying_t;

// Hovers at 0.3 m, taken over in flight from whoever flew.
static void start(flying_t *f) {
  rig6_param_t body = rig6_crazyflie();
  f->rig = rig6_at(&body, d3(0.0, 0.0, 0.3), 0.0, true);
  f->set = rig6_hold(d3(0.0, 0.0, 0.3), 0.0);
  crazyflie_init(&f->vehicle, NULL);
  CHECK(crazyflie_set(&f->vehicle, "indiPos.mass", body.mass_kg));
  CHECK(crazyflie_set(&f->vehicle, "indiPos.tauMot", body.tau_s));
  crazyflie_start(&f->vehicle);
}

static void fly(flying_t *f, int ms) {
  for (int i = 0; i < ms; i++) {
    double motor_N[PILOT6_MOTORS];
    const pilot6_in_t in = rig6_sense(&f->rig, &f->set);
    crazyflie_ms(&f->vehicle, &in, motor_N);
    rig6_step(&f->rig, motor_N);
  }
}

static double log_of(const flying_t *f, const char *name) {
  double value = (double)NAN;
  CHECK(crazyflie_log(&f->vehicle, name, &value));
  return value;
}

// --- parameters -------------------------------------------------------------------------------------------

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
  start(&alone);
  start(&poked);
  fly(&alone, 500);
  fly(&poked, 500);
  const int n = (int)(sizeof bad / sizeof *bad);
  for (int i = 0; i < n; i++) {
    ROW("%s = %g", bad[i].name, bad[i].value);
    double before, after;
    CHECK(crazyflie_param(&poked.vehicle, bad[i].name, &before));
    CHECK(crazyflie_set(&poked.vehicle, bad[i].name, bad[i].value));
    fly(&alone, 7);
    fly(&poked, 7);
    CHECK(memcmp(&alone.rig, &poked.rig, sizeof alone.rig) == 0);
    CHECK(memcmp(&alone.vehicle.app.flight, &poked.vehicle.app.flight, sizeof(flight_t)) == 0);
    CHECK(log_of(&poked, "ceil.noSet") == i + 1);
    CHECK(crazyflie_param(&poked.vehicle, bad[i].name, &after));
    // Out of its range: the old value is back. In range, but against another one: it waits, so put it back.
    const bool in_range = strcmp(bad[i].name, "rls.zMin") == 0 || i == n - 1;
    CHECK(in_range || after == before);
    if (in_range) CHECK(crazyflie_set(&poked.vehicle, bad[i].name, before));
  }
}

TEST(app_takes_weights_as_a_whole_and_only_when_told_to) {
  static flying_t f;
  start(&f);
  fly(&f, 100);
  const rbf_weights_t before = f.vehicle.app.flown.curve.fixed;
  char name[] = "ceil.w1";
  for (int i = 0; i < RBF_N; i++) {
    name[6] = (char)('1' + i);
    CHECK(crazyflie_set(&f.vehicle, name, i == 0 ? 1.0 : 0.01 * i));
    fly(&f, 1); // between two writes a tick
    CHECK(memcmp(&f.vehicle.app.flight.param.curve.fixed, &before, sizeof before) == 0);
  }
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  fly(&f, 1);
  CHECK(f.vehicle.app.flight.param.curve.fixed.w[0] == 1.0f);
  CHECK(f.vehicle.app.flight.param.curve.fixed.w[6] == 0.06f);
  CHECK(f.vehicle.app.flight.outer.learn.rls.theta.w[6] == 0.06f); // learning goes on from there
  CHECK(log_of(&f, "ceil.commits") == 1.0);
  // One that is no number: none is taken.
  CHECK(crazyflie_set(&f.vehicle, "ceil.w2", 0.5));
  CHECK(crazyflie_set(&f.vehicle, "ceil.w3", (double)NAN));
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  fly(&f, 1);
  CHECK(f.vehicle.app.flight.param.curve.fixed.w[1] == 0.01f);
  CHECK(log_of(&f, "ceil.noCommit") == 1.0);
  double commit = 9.0;
  CHECK(crazyflie_param(&f.vehicle, "ceil.commit", &commit) && commit == 0.0);
}

TEST(app_commits_learned_weights_but_not_while_it_learns) {
  static flying_t f;
  start(&f);
  CHECK(crazyflie_set(&f.vehicle, "ceil.mode", CURVE_LIVE));
  fly(&f, 100);
  CHECK(log_of(&f, "ceil.learning") == 1.0);
  f.vehicle.app.flight.outer.learn.rls.theta.w[3] = 0.123f;
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_LEARNED));
  fly(&f, 1);
  CHECK(log_of(&f, "ceil.noCommit") == 1.0 && f.vehicle.app.flown.curve.fixed.w[3] != 0.123f);
  CHECK(crazyflie_set(&f.vehicle, "ceil.mode", CURVE_FIXED));
  fly(&f, 1);
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_LEARNED));
  fly(&f, 1);
  double w4 = 0.0;
  CHECK(crazyflie_param(&f.vehicle, "ceil.w4", &w4)); // from here it can be stored
  CHECK((float)w4 == 0.123f && f.vehicle.app.flown.curve.fixed.w[3] == 0.123f);
}

// --- who flies --------------------------------------------------------------------------------------------

TEST(app_takes_over_in_flight_without_a_bump_and_gives_back_likewise) {
  static flying_t f;
  start(&f);
  double low_m = 1.0, high_m = 0.0, tilt_rad = 0.0;
  for (int ms = 0; ms < 12000; ms++) {
    // The stock controller from 4 s to 8 s. It has to find its integrals first, from which this one holds it.
    if (ms == 4000) CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 1));
    if (ms == 8000) CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 0));
    fly(&f, 1);
    low_m = fmin(low_m, f.rig.pos_w_m.z);
    high_m = fmax(high_m, f.rig.pos_w_m.z);
    tilt_rad = fmax(tilt_rad, rig6_tilt_rad(&f.rig));
    if (ms == 3999) {
      CHECK_NEAR(low_m, 0.3, 0.003);
      CHECK_NEAR(high_m, 0.3, 0.003);
    }
    if (ms == 7000) CHECK(log_of(&f, "indi.stock") == 1.0);
  }
  ROW("lowest %.3f m, highest %.3f m", low_m, high_m);
  CHECK(low_m > 0.18 && high_m < 0.33); // the stock one sinks by 10 cm until its integral carries: measured
  CHECK(tilt_rad < 0.05);
  CHECK_NEAR(f.rig.pos_w_m.z, 0.3, 0.005);
}

TEST(app_in_shadow_commands_what_the_stock_controller_does_and_computes_its_own) {
  static flying_t f;
  start(&f);
  CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 1));
  crazyflie_start(&f.vehicle);
  stock_pid_t pid;
  const stock_pid_param_t param = f.vehicle.stock.param;
  const pilot6_t stock = stock_pid_pilot(&pid, &param);
  double worst_N = 0.0;
  for (int ms = 0; ms < 2000; ms++) {
    const pilot6_in_t in = rig6_sense(&f.rig, &f.set);
    double motor_N[PILOT6_MOTORS], stock_N[PILOT6_MOTORS];
    crazyflie_ms(&f.vehicle, &in, motor_N);
    stock.step(stock.state, &in, stock_N);
    if (ms > 500) // its filtered battery voltage starts elsewhere
      for (int i = 0; i < PILOT6_MOTORS; i++) worst_N = fmax(worst_N, fabs(motor_N[i] - stock_N[i]));
    rig6_step(&f.rig, motor_N);
  }
  CHECK(worst_N < 1e-4);
  CHECK_NEAR(log_of(&f, "indi.thrust"), 9.81 * f.rig.param.mass_kg, 0.05);
}

TEST(app_that_contradicts_itself_does_not_take_off) {
  static flying_t f;
  start(&f);
  rig6_param_t body = rig6_crazyflie();
  body.floor = true;
  f.rig = rig6_at(&body, d3(0.0, 0.0, 0.0), 0.0, false);
  f.set.mode[2] = PILOT6_OFF;
  for (int ms = 0; ms < 4000; ms++) {
    if (ms == 1000) f.set.mode[2] = PILOT6_POSITION;
    pilot6_in_t in = rig6_sense(&f.rig, &f.set);
    in.acc_b_mps2.z = -in.acc_b_mps2.z;
    double motor_N[PILOT6_MOTORS];
    crazyflie_ms(&f.vehicle, &in, motor_N);
    for (int i = 0; i < PILOT6_MOTORS; i++) CHECK(motor_N[i] == 0.0);
    rig6_step(&f.rig, motor_N);
  }
  CHECK(log_of(&f, "guard.notFlyable") == FLYABLE_UP);
}

TEST(app_counts_as_applied_nothing_while_the_motors_are_not_allowed_to_run) {
  static flying_t f;
  start(&f);
  fly(&f, 50);
  CHECK(log_of(&f, "indiIn.f1") > 0.05);
  f.vehicle.around.motors_allowed = false;
  fly(&f, 1);
  CHECK(log_of(&f, "indiIn.f1") == 0.0);
}

TEST(app_teaches_nothing_while_the_supervisor_says_it_does_not_fly) {
  static flying_t f;
  start(&f);
  CHECK(crazyflie_set(&f.vehicle, "ceil.mode", CURVE_LIVE));
  rig6_param_t body = rig6_crazyflie();
  body.floor = true;
  f.rig = rig6_at(&body, d3(0.0, 0.0, 0.0), 0.0, false);
  crazyflie_start(&f.vehicle);
  f.vehicle.around.motors_allowed = false;
  fly(&f, 3000);
  CHECK(log_of(&f, "rls.taught") == 0.0 && log_of(&f, "indiIn.noLesson") == 1.0);
}

// --- the task ---------------------------------------------------------------------------------------------

static jmp_buf out;
static int naps;
static void nap(void *context, uint32_t ticks) {
  (void)ticks;
  crazyflie_t *const c = context;
  if (naps == 0) c->app.flyable.not_flyable = FLYABLE_UP;
  if (naps++ == 2) longjmp(out, 1);
}

TEST(app_says_on_the_console_what_is_missing_and_what_is_wrong) {
  static const struct {
    bool flow, multiranger;
    const char *want;
  } row[] = {{true, true, "Flow and multiranger decks are there"},
             {false, true, "MISSING: flow deck"},
             {true, false, "MISSING: multiranger deck"}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    static crazyflie_t c;
    crazyflie_init(&c, NULL);
    crazyflie_start(&c);
    c.around.has_flow = row[i].flow;
    c.around.has_multiranger = row[i].multiranger;
    c.around.delay = nap;
    c.around.delay_context = &c;
    naps = 0;
    if (setjmp(out) == 0) appMain();
    ROW("%s: %s", row[i].want, c.around.console);
    CHECK(strstr(c.around.console, row[i].want) != NULL);
    CHECK(strstr(c.around.console, "NOT FLYABLE: at rest") != NULL);
  }
}
