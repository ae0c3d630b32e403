// test_app_client.c - what the client on the ground is notified of: it shows what it wrote, until it hears
// better.
#include "crazyflie/sections.h"
#include "rig/flying_app.h"
#include "rig/test.h"

#include <string.h>

// A client as the firmware's own is: of what it writes it believes the echo, and then what it is told.
typedef struct {
  flying_t flying;
  const section_param_t *param; // that it looks at
  double shown;
  int notified; // of all parameters
} watched_t;

static void hear(void *context, const section_param_t *param, double value) {
  watched_t *const w = context;
  w->notified++;
  if (param == w->param) w->shown = value;
}

static void ticks(void *context, uint32_t ms) {
  app_fly(&((watched_t *)context)->flying, (int)ms);
}

static void start(watched_t *w) {
  app_start(&w->flying);
  w->notified = 0;
  stand_in_t *const around = &w->flying.vehicle.around;
  around->told = hear;
  around->delay = ticks; // while the parameter task rests, the others run
  around->told_context = around->delay_context = w;
}

static void type(watched_t *w, const char *name, double value) {
  w->param = sections_param(name);
  w->shown = value;
  CHECK(crazyflie_set(&w->flying.vehicle, name, value));
}

static double param(const watched_t *w, const char *name) {
  double value = (double)NAN;
  CHECK(crazyflie_param(&w->flying.vehicle, name, &value));
  return value;
}

TEST(app_tells_the_client_of_every_parameter_that_it_puts_back) {
  static watched_t w;
  start(&w);
  app_fly(&w.flying, 10);
  for (int i = 0; i < params_count; i++) {
    const param_row_t *row = &params_table[i];
    const bool whole = row->type == PARAM_INT;
    const double odd[] = {(double)row->max * 1.01 + 1.0, (double)row->min - 1.0, whole ? 1e9 : (double)NAN};
    for (unsigned k = 0; k < sizeof odd / sizeof *odd; k++) {
      ROW("%s = %g", row->name, odd[k]);
      const double before = param(&w, row->name);
      w.notified = 0;
      type(&w, row->name, odd[k]);
      const bool weight = strncmp(strchr(row->name, '.'), ".w", 2) == 0 &&
                          strlen(strchr(row->name, '.')) == 3; // judged when it is to be flown
      if (weight) CHECK(crazyflie_set(&w.flying.vehicle, "ceil.commit", COMMIT_TYPED));
      CHECK(w.shown == before && param(&w, row->name) == before);
      CHECK(w.notified == (weight ? 2 : 1)); // of that one alone, once, and that the commit is over
    }
  }
}

TEST(app_puts_nothing_back_that_is_at_a_bound_of_its_range) {
  static watched_t w;
  for (int high = 0; high < 2; high++) {
    start(&w);
    app_fly(&w.flying, 10);
    flight_param_t *const tuned = &w.flying.vehicle.app.tuned;
    for (int i = 0; i < params_count; i++) {
      const param_row_t *const row = &params_table[i];
      CHECK_OK(params_set(tuned, row, high ? row->max : row->min));
    }
    type(&w, "indiPos.kp", -1.0);
    CHECK(w.notified == 1 && w.shown == 0.5);
    for (int i = 0; i < params_count; i++) {
      const param_row_t *const row = &params_table[i];
      ROW("%s", row->name);
      if (strcmp(row->name, "indiPos.kp") != 0) CHECK(params_get(tuned, row) == (high ? row->max : row->min));
    }
  }
}

TEST(app_tells_the_client_with_its_next_write_which_weights_it_put_back_at_the_start) {
  static watched_t w;
  start(&w);
  rbf_weights_t *const stored = &w.flying.vehicle.app.tuned.curve.fixed;
  stored->w[1] += 0.25f; // without the sum of such a set
  stored->w[6] += 0.25f;
  crazyflie_start(&w.flying.vehicle);
  CHECK(w.notified == 0);
  type(&w, "ceil.shadow", 0.0);
  CHECK(w.notified == 2);
}

TEST(app_takes_more_than_the_largest_shadow_for_the_largest_and_says_so) {
  static watched_t w;
  start(&w);
  app_fly(&w.flying, 10);
  type(&w, "ceil.shadow", 7.0);
  CHECK(w.notified == 1 && param(&w, "ceil.shadow") == 1.0);
}

TEST(app_tells_nothing_of_what_it_takes_or_lets_wait) {
  static watched_t w;
  start(&w);
  app_fly(&w.flying, 10);
  type(&w, "indiPos.kp", 2.0);
  type(&w, "rls.zMin", 0.1); // against rls.zMax: the next write may mend it
  CHECK(param(&w, "rls.zMin") == (double)0.1f);
  type(&w, "ceil.w2", 0.25);
  type(&w, "ceil.shadow", 1.0);
  CHECK(w.notified == 0);
}

TEST(app_tells_the_client_when_a_commit_is_done_and_what_came_of_it) {
  static watched_t w;
  start(&w);
  app_fly(&w.flying, 10);
  type(&w, "ceil.w2", 0.25);
  type(&w, "ceil.commit", COMMIT_TYPED);
  CHECK(w.shown == 0.0 && w.notified == 2); // ceil.commit and ceil.wSum
  CHECK(app_log(&w.flying, "ceil.commits") == 1.0);
  // The learned ones stand in the parameters now.
  w.flying.vehicle.app.flight.outer.learn.rls.theta.w[3] = 0.125f;
  w.param = sections_param("ceil.w4");
  w.notified = 0;
  CHECK(crazyflie_set(&w.flying.vehicle, "ceil.commit", COMMIT_LEARNED));
  CHECK(w.shown == 0.125 && w.notified == 2 * RBF_N + 2);
  // Refused in the tick: it learns.
  type(&w, "ceil.mode", CURVE_LIVE);
  app_fly(&w.flying, 3 * SUPERVISED_PERIOD_MS);
  w.notified = 0;
  type(&w, "ceil.commit", COMMIT_LEARNED);
  CHECK(w.shown == 0.0 && app_log(&w.flying, "ceil.noCommit") == 1.0);
  CHECK(param(&w, "ceil.w4") == 0.125);
}

// Rests of the parameter task, and the one in which a tick takes what it waits for; 0: another controller
// flies, and none does.
typedef struct {
  watched_t *watched;
  int rests, taken_in;
  uint32_t waited_ms;
} waiting_t;

static void rest(void *context, uint32_t ms) {
  waiting_t *const w = context;
  w->waited_ms += ms;
  if (++w->rests == w->taken_in) app_fly(&w->watched->flying, 2);
}

TEST(app_waits_for_a_tick_no_longer_than_the_link_bears) {
  static const struct {
    int taken_in, rests;
    bool notified;
  } row[] = {{1, 1, true}, {9, 9, true}, {10, 10, true}, {11, 10, false}, {0, 10, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("taken in rest %d", row[i].taken_in);
    static watched_t w;
    start(&w);
    app_fly(&w.flying, 10);
    waiting_t waiting = {.watched = &w, .taken_in = row[i].taken_in};
    w.flying.vehicle.around.delay = rest;
    w.flying.vehicle.around.delay_context = &waiting;
    type(&w, "ceil.commit", COMMIT_TYPED);
    CHECK_NEAR(waiting.rests, row[i].rests, 0);
    CHECK_NEAR(waiting.waited_ms, 2 * row[i].rests, 0); // a tick takes it every second millisecond
    CHECK(w.shown == (row[i].notified ? 0.0 : COMMIT_TYPED));
    CHECK((w.notified > 0) == row[i].notified);
  }
}

TEST(app_tells_of_each_parameter_once_and_of_none_beyond_the_last) {
  static watched_t w;
  start(&w);
  app_fly(&w.flying, 10);
  uint32_t *const put_back = w.flying.vehicle.app.put_back;
  CHECK(params_count <= 32 * PUT_BACK_WORDS);
  memset(put_back, 0xff, sizeof w.flying.vehicle.app.put_back); // also what is of no parameter
  type(&w, "ceil.shadow", 1.0);
  CHECK_NEAR(w.notified, params_count, 0);
  for (int i = 0; i < PUT_BACK_WORDS; i++) CHECK(put_back[i] == 0);
}

TEST(app_lets_nobody_else_write_the_sum_of_the_weights) {
  static watched_t w;
  start(&w);
  app_fly(&w.flying, 10);
  const double before = param(&w, "ceil.wSum");
  type(&w, "ceil.wSum", 12345.0);
  CHECK(w.shown == before && param(&w, "ceil.wSum") == before);
}
