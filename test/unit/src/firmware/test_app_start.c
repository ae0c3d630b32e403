// test_app_start.c - what the app makes of stored parameters when the power comes, and what it says then.
#include "app.h"
#include "crazyflie/sections.h"
#include "rig/flying_app.h"
#include "param.h"
#include "rig/test.h"

#include <setjmp.h>
#include <string.h>

static const char *const weight_name[RBF_N] = {"ceil.w1", "ceil.w2", "ceil.w3", "ceil.w4",
                                               "ceil.w5", "ceil.w6", "ceil.w7"};

// --- the console ------------------------------------------------------------------------------------------

static jmp_buf out;

static void stop(void *context, uint32_t ticks) {
  (void)context, (void)ticks;
  longjmp(out, 1);
}

// What the task has said by its first rest.
static const char *console(crazyflie_t *c) {
  c->around.delay = stop;
  c->around.console[0] = '\0';
  if (setjmp(out) == 0) appMain();
  c->around.delay = NULL;
  return c->around.console;
}

TEST(app_says_at_the_start_what_it_is_which_decks_there_are_and_who_flies) {
  static const struct {
    bool shadow, usd;
    const char *want, *never;
  } row[] = {{true, false, "SHADOW: the stock controller flies", "This controller flies"},
             {false, false, "This controller flies", "SHADOW"},
             {true, false, ", for legacy propellers", "uSD deck"},
             {true, true, "uSD deck is there", "MISSING"},
             {true, true, "Ceiling controller ", "REFUSED"}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    static crazyflie_t c;
    crazyflie_init(&c, NULL);
    CHECK(crazyflie_set(&c, "ceil.shadow", row[i].shadow));
    crazyflie_start(&c);
    c.around.has_usd = row[i].usd;
    const char *const said = console(&c);
    ROW("%s: %s", row[i].want, said);
    CHECK(strstr(said, row[i].want) != NULL);
    CHECK(strstr(said, row[i].never) == NULL);
  }
}

// What changes while it runs: set before a rest of the task, said after it.
static const struct {
  const char *what;
  unsigned not_flyable, latched, not_flown;
  bool mixed, shadow;
  const char *want; // all that is said
} change[] = {
    {"nothing", 0, 0, 0, false, false, ""},
    {"up", FLYABLE_UP, 0, 0, false, false,
     "CEIL: NOT FLYABLE: at rest the accelerometer does not point up\n"},
    {"up still", FLYABLE_UP, 0, 0, false, false, ""},
    {"turns about x", FLYABLE_TURN_X, 0, 0, false, false,
     "CEIL: NOT FLYABLE: gyro and accelerometer contradict each other along x\n"},
    {"turns about y", FLYABLE_TURN_Y, 0, 0, false, false,
     "CEIL: NOT FLYABLE: gyro and accelerometer contradict each other along y\n"},
    {"flyable", 0, 0, 0, false, false, "CEIL: Flyable again\n"},
    {"a reason", 0, 0x10, 0, false, false, "CEIL: Guard: reasons 0x10\n"},
    {"rates", 0, 0x10, NOT_FLOWN_RATES, false, false,
     "CEIL: REFUSED: set points of rates. Level, at that thrust\n"},
    {"another kind", 0, 0x10, NOT_FLOWN_RATES | NOT_FLOWN_QUAT, false, false,
     "CEIL: REFUSED: attitude as quaternion without position. Level, at that thrust\n"},
    {"a third", 0, 0x10, NOT_FLOWN_RATES | NOT_FLOWN_QUAT | NOT_FLOWN_TURN, false, false,
     "CEIL: REFUSED: rates of roll and pitch of a full state. The rest is flown\n"},
    {"selected anew", 0, 0, 0, true, false,
     "CEIL: WEIGHTS REFUSED: w1..w7 of ceil and ground are not one set (ceil.wSum). The last good ones fly\n"
     "CEIL: Guard: reasons 0x0\n"},
    {"mixed still", 0, 0, 0, true, false, ""},
    {"shadow", 0, 0, 0, true, true,
     "CEIL: SHADOW: the stock controller flies, this one computes (ceil.shadow 0: it flies)\n"},
    {"back", 0, 0, 0, false, false, "CEIL: This controller flies (ceil.shadow 1: the stock one)\n"},
};
#define CHANGES (int)(sizeof change / sizeof *change)

static int rests, tenths;

// Twice a second something is told; the radio is watched ten times a second.
static void change_something(void *context, uint32_t ticks) {
  CHECK(ticks == 100);
  crazyflie_t *const c = context;
  if (tenths++ % 5 != 0) {
    CHECK_TEXT(c->around.console, "");
    return;
  }
  if (rests > 0) {
    ROW("%s", change[rests - 1].what);
    CHECK_TEXT(c->around.console, change[rests - 1].want);
  }
  if (rests == CHANGES) longjmp(out, 1);
  c->around.console[0] = '\0';
  c->app.flyable.not_flyable = change[rests].not_flyable;
  c->app.flight.guard.latched = change[rests].latched;
  c->app.not_flown = (uint8_t)change[rests].not_flown;
  c->app.weights_mixed = change[rests].mixed;
  c->app.shadow = change[rests].shadow;
  rests++;
}

TEST(app_says_once_what_changes_while_it_runs) {
  static crazyflie_t c;
  crazyflie_init(&c, NULL);
  CHECK(crazyflie_set(&c, "ceil.shadow", 0));
  crazyflie_start(&c);
  c.around.no_usd_driver = c.around.has_usd = true;
  c.around.delay = change_something;
  c.around.delay_context = &c;
  rests = tenths = 0;
  if (setjmp(out) == 0) appMain();
  CHECK(rests == CHANGES);
}

// --- stored values ----------------------------------------------------------------------------------------

// As the firmware does when the power comes: stored values without a callback, then the controller.
static void power_up(crazyflie_t *c, const double weight[RBF_N], double sum) {
  crazyflie_init(c, NULL);
  for (int i = 0; i < RBF_N; i++) c->app.tuned.curve.fixed.w[i] = (float)weight[i];
  c->app.weights_sum = (uint32_t)sum;
  crazyflie_start(c);
}

TEST(app_starts_in_shadow_until_another_choice_is_stored) {
  static crazyflie_t c;
  crazyflie_init(&c, NULL);
  crazyflie_start(&c);
  double shadow = 9.0;
  CHECK(crazyflie_param(&c, "ceil.shadow", &shadow) && shadow == 1.0);
  CHECK(sections_param("ceil.shadow")->type & PARAM_PERSISTENT);
  CHECK(c.app.stock_share == 1.0f);
  crazyflie_init(&c, NULL);
  c.app.shadow = 0; // stored
  crazyflie_start(&c);
  CHECK(c.app.stock_share == 0.0f);
}

// The weights and their sum as a client reads them, to be stored.
static double read_back(const crazyflie_t *c, double weight[RBF_N]) {
  double sum = (double)NAN;
  for (int i = 0; i < RBF_N; i++) CHECK(crazyflie_param(c, weight_name[i], &weight[i]));
  CHECK(crazyflie_param(c, "ceil.wSum", &sum));
  return sum;
}

static double committed(const double wanted[RBF_N], double weight[RBF_N]) {
  static flying_t f;
  app_start(&f);
  for (int i = 0; i < RBF_N; i++) CHECK(crazyflie_set(&f.vehicle, weight_name[i], wanted[i]));
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  app_fly(&f, 4);
  CHECK(app_log(&f, "ceil.commits") == 1.0);
  return read_back(&f.vehicle, weight);
}

static bool flies(const crazyflie_t *c, const double weight[RBF_N]) {
  bool same = true;
  for (int i = 0; i < RBF_N; i++)
    same = same && c->app.flight.outer.param.curve.fixed.w[i] == (float)weight[i] &&
           c->app.flight.outer.learn.rls.theta.w[i] == (float)weight[i] &&
           c->app.tuned.curve.fixed.w[i] == (float)weight[i]; // what reads back is what flies
  return same;
}

TEST(app_flies_stored_weights_as_a_whole_wherever_storing_them_was_interrupted) {
  static crazyflie_t c;
  double shipped[RBF_N], before[RBF_N], after[RBF_N];
  crazyflie_init(&c, NULL);
  CHECK(read_back(&c, shipped) == 0.0); // nothing was stored
  const double sum_before = committed((const double[RBF_N]){1.1, 0.2, -0.1, 0, 0.1, -0.2, 0.3}, before);
  const double sum_after = committed((const double[RBF_N]){1.0, -0.2, 0.1, 0.4, -0.1, 0.2, -0.3}, after);
  CHECK(sum_before != 0.0 && sum_after != 0.0 && sum_before != sum_after);
  // Of eight values any may have been written when the power went.
  for (unsigned written = 0; written < 256; written++) {
    ROW("written: 0x%x", written);
    for (int from = 0; from < 2; from++) { // over the set of before, over nothing
      double stored[RBF_N];
      for (int i = 0; i < RBF_N; i++)
        stored[i] = written & (1u << i) ? after[i] : from == 0 ? before[i] : shipped[i];
      power_up(&c, stored, written & 128 ? sum_after : from == 0 ? sum_before : 0.0);
      const bool whole = written == 0 || written == 255;
      CHECK(flies(&c, written == 255 ? after : written == 0 && from == 0 ? before : shipped));
      CHECK((strstr(console(&c), "WEIGHTS REFUSED") == NULL) == whole);
      double now[RBF_N];
      const double sum = read_back(&c, now);
      CHECK(sum == (written == 255 ? sum_after : written == 0 && from == 0 ? sum_before : 0.0));
    }
  }
}

TEST(app_sums_weights_so_that_any_bit_and_any_exchange_counts) {
  static crazyflie_t c;
  double weight[RBF_N], other[RBF_N];
  const double sum = committed((const double[RBF_N]){1.1, 0.2, -0.2, 0.4, 0.1, -0.1, 0.3}, weight);
  for (int i = 0; i < RBF_N; i++) {
    for (int bit = 0; bit < 32; bit++) {
      ROW("weight %d, bit %d", i + 1, bit);
      memcpy(other, weight, sizeof other);
      power_up(&c, other, sum);
      CHECK(!c.app.weights_mixed);
      crazyflie_init(&c, NULL);
      for (int k = 0; k < RBF_N; k++) c.app.tuned.curve.fixed.w[k] = (float)weight[k];
      uint32_t bits;
      memcpy(&bits, &c.app.tuned.curve.fixed.w[i], sizeof bits);
      bits ^= 1u << bit;
      memcpy(&c.app.tuned.curve.fixed.w[i], &bits, sizeof bits);
      c.app.weights_sum = (uint32_t)sum;
      crazyflie_start(&c);
      CHECK(c.app.weights_mixed);
    }
    for (int k = 0; k < i; k++) {
      ROW("weights %d and %d: exchanged, both with another sign", i + 1, k + 1);
      memcpy(other, weight, sizeof other);
      other[i] = weight[k];
      other[k] = weight[i];
      power_up(&c, other, sum);
      CHECK(c.app.weights_mixed);
      other[i] = -weight[i];
      other[k] = -weight[k];
      power_up(&c, other, sum);
      CHECK(c.app.weights_mixed);
    }
  }
}

TEST(app_selected_anew_flies_the_weights_of_before_and_those_whose_commit_waited) {
  static flying_t f;
  app_start(&f);
  double weight[RBF_N], now[RBF_N];
  CHECK(crazyflie_set(&f.vehicle, "ceil.w2", 0.25));
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  app_fly(&f, 4);
  const double sum = read_back(&f.vehicle, weight);
  CHECK(crazyflie_set(&f.vehicle, "ceil.w3", 0.5)); // typed, and not committed
  crazyflie_start(&f.vehicle);
  CHECK(f.vehicle.app.weights_mixed && flies(&f.vehicle, weight));
  CHECK(read_back(&f.vehicle, now) == sum);
  // While another controller flew no tick took it.
  CHECK(crazyflie_set(&f.vehicle, "ceil.w3", 0.5));
  CHECK(crazyflie_set(&f.vehicle, "ceil.commit", COMMIT_TYPED));
  crazyflie_start(&f.vehicle);
  weight[2] = 0.5;
  CHECK(!f.vehicle.app.weights_mixed && flies(&f.vehicle, weight));
  CHECK(read_back(&f.vehicle, now) != sum);
}

TEST(app_selected_anew_keeps_the_set_that_flew_where_the_parameters_contradict_each_other) {
  static flying_t f;
  app_start(&f);
  CHECK(crazyflie_set(&f.vehicle, "indiPos.kp", 2.0));
  app_fly(&f, 4);
  CHECK(crazyflie_set(&f.vehicle, "rls.zMin", 0.1)); // not below rls.zMax: it waits for the next write
  crazyflie_start(&f.vehicle);
  CHECK(f.vehicle.app.flight.outer.param.pos.kp_per_s == 2.0f);
  double kp = 0.0, z_min = 0.0;
  CHECK(crazyflie_param(&f.vehicle, "indiPos.kp", &kp) && kp == 2.0);
  CHECK(crazyflie_param(&f.vehicle, "rls.zMin", &z_min) && (float)z_min == 0.005f);
}

TEST(app_starts_with_the_defaults_for_stored_values_that_it_does_not_allow) {
  static crazyflie_t c;
  crazyflie_init(&c, NULL);
  c.app.tuned.pos.kp_per_s = 1e9f; // stored by another version
  c.app.tuned.pos.kd_per_s = 6.0f;
  crazyflie_start(&c);
  CHECK(c.app.flight.outer.param.pos.kp_per_s == 0.5f && c.app.tuned.pos.kp_per_s == 0.5f);
  CHECK(c.app.flight.outer.param.pos.kd_per_s == 6.0f);
  CHECK(strstr(console(&c), "Parameters refused") != NULL);
}
