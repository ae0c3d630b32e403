// test_app_calls.c - one call of the app: what it takes from the firmware, keeps for the next call and
// commands.
#include "crazyflie/controller.h"
#include "crazyflie/crazyflie.h"
#include "crazyflie/range.h"
#include "firmware/units.h"
#include "rig/test.h"

// What the firmware hands the app in a call.
typedef struct {
  crazyflie_t vehicle;
  control_t control;
  setpoint_t setpoint;
  sensorData_t sensors;
  state_t state;
  uint32_t step;
} border_t;

static void call(border_t *b, int calls) {
  for (; calls > 0; calls--)
    controllerOutOfTree(&b->control, &b->setpoint, &b->sensors, &b->state, b->step++);
}

// In the air, level, by hand; this controller flies.
static void start(border_t *b) {
  *b = (border_t){.control = {.controlMode = controlModeForce, .normalizedForces = {0.6f, 0.6f, 0.6f, 0.6f}},
                  .setpoint = {.thrust = 40000.0f, .mode = {.roll = modeAbs, .pitch = modeAbs}},
                  .sensors = {.acc = {.z = 1.0f}},
                  .state = {.attitudeQuaternion = {.w = 1.0f}}};
  crazyflie_init(&b->vehicle, NULL);
  b->vehicle.app.shadow = 0;
  b->vehicle.around.stock = NULL;
  crazyflie_start(&b->vehicle);
  b->vehicle.around.flying = true;
  b->vehicle.around.battery_V = 4.0f;
}

// --- selected ---------------------------------------------------------------------------------------------

TEST(app_selected_anew_knows_nothing_of_what_was_before) {
  static border_t b;
  start(&b);
  b.setpoint.mode.roll = modeVelocity;
  b.vehicle.around.range_mm[rangeUp] = 500;
  call(&b, 20);
  glue_t *const app = &b.vehicle.app;
  app->flyable.not_flyable = FLYABLE_UP;
  CHECK(app->range.started && app->not_flown != 0 && app->recorder.calls == 20);
  CHECK(b.vehicle.around.stock_starts == 1);
  controllerOutOfTreeInit();
  CHECK(b.vehicle.around.stock_starts == 2);
  CHECK(!app->range.started && app->not_flown == 0 && app->recorder.calls == 0);
  CHECK(app->flyable.not_flyable == 0 && app->flight.phase == 0 && !app->flight.called);
}

TEST(app_passes_the_firmwares_test_where_its_parameters_can_be_flown) {
  static border_t b;
  start(&b);
  CHECK(controllerOutOfTreeTest());
  b.vehicle.app.flown.pos.mass_kg = 0.0f; // a flipped bit
  CHECK(!controllerOutOfTreeTest());
}

// --- inputs -----------------------------------------------------------------------------------------------

TEST(app_keeps_a_range_sample_and_its_age_until_the_next_one) {
  static const struct {
    int calls; // since the row before
    uint16_t mm;
    bool is_new;
    float range_m, age_s;
  } row[] = {
      {1, 500, true, 0.5f, RANGE_UP_AGE_S},
      {1, 500, false, 0.5f, RANGE_UP_AGE_S},
      {118, 500, false, 0.5f, RANGE_UP_AGE_S},
      {1, 500, true, 0.5f, RANGE_UP_AGE_S + 0.02f}, // late: it may be another that is the same
      {1, 500, false, 0.5f, RANGE_UP_AGE_S + 0.02f},
      {50, 400, false, 0.4f, RANGE_UP_AGE_S},
      {1, 300, true, 0.3f, RANGE_UP_AGE_S},
  };
  static border_t b;
  start(&b);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    b.vehicle.around.range_mm[rangeUp] = row[i].mm;
    call(&b, row[i].calls);
    const flight_in_t *in = &b.vehicle.app.in;
    CHECK(in->range_new == row[i].is_new);
    CHECK_NEAR(in->range_m, row[i].range_m, 1e-6);
    CHECK_NEAR(in->range_age_s, row[i].age_s, 1e-6);
  }
}

TEST(app_looks_for_what_it_does_not_fly_in_the_call_of_ten_of_the_height_filter) {
  for (uint32_t at = 0; at < 10; at++) {
    ROW("millisecond %u of ten", (unsigned)at);
    static border_t b;
    start(&b);
    call(&b, 20 + (int)at);
    b.setpoint.mode.roll = modeVelocity;
    call(&b, 1);
    b.setpoint.mode.roll = modeAbs;
    if (at == 2) CHECK(b.vehicle.app.flight.due == FLIGHT_HEIGHT); // and without it, of no loop
    call(&b, 20);
    CHECK(b.vehicle.app.not_flown == (at == 2 ? NOT_FLOWN_RATES : 0));
  }
}

TEST(app_keeps_in_mind_each_kind_of_set_point_that_it_did_not_fly) {
  static border_t b;
  start(&b);
  b.setpoint.mode.roll = modeVelocity;
  call(&b, 10);
  b.setpoint.mode = (setpoint_mode_t){.quat = modeAbs};
  call(&b, 10);
  b.setpoint.mode = (setpoint_mode_t){.z = modeAbs};
  call(&b, 10);
  CHECK(b.vehicle.app.not_flown == (NOT_FLOWN_RATES | NOT_FLOWN_QUAT));
}

// --- who commands -----------------------------------------------------------------------------------------

TEST(app_hands_over_within_a_second_in_the_air_and_at_once_on_the_floor) {
  static const struct {
    int calls;
    double given;
  } row[] = {{1, 0.001}, {250, 0.25}, {500, 0.5}, {998, 0.998}, {1001, 1.0}, {1500, 1.0}};
  static border_t b;
  start(&b);
  call(&b, 5);
  CHECK(b.vehicle.app.stock_share == 0.0f);
  for (int shadow = 1; shadow >= 0; shadow--) {
    b.vehicle.app.shadow = (uint8_t)shadow;
    for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
      ROW("shadow %d, call %d", shadow, row[i].calls);
      call(&b, row[i].calls - (i > 0 ? row[i - 1].calls : 0));
      CHECK_NEAR(b.vehicle.app.stock_share, shadow ? row[i].given : 1.0 - row[i].given, 1e-4);
    }
    CHECK(b.vehicle.app.stock_share == (shadow ? 1.0f : 0.0f));
  }
  b.vehicle.around.flying = false;
  b.vehicle.app.shadow = 1;
  call(&b, 1);
  CHECK(b.vehicle.app.stock_share == 1.0f);
}

// What it commands.
static const control_t STOCK = {.roll = 2000, .pitch = -1000, .yaw = 500, .thrust = 30000.0f};

typedef struct {
  int calls;
  uint32_t step;      // of the last one
  float thrust;       // that it was asked for
  int nothing_in_all; // calls in step 0 that ask for nothing
} stock_seen_t;

static void watch(void *context, control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                  const state_t *state, uint32_t step) {
  (void)sensors, (void)state;
  stock_seen_t *const s = context;
  s->calls++;
  s->step = step;
  s->thrust = setpoint->thrust;
  s->nothing_in_all += step == 0 && setpoint->thrust == 0.0f && setpoint->mode.roll == modeDisable;
  *control = STOCK;
}

TEST(app_has_the_stock_controller_let_go_of_what_it_knew_before_it_flies_again) {
  static border_t b;
  start(&b);
  stock_seen_t seen = {.calls = 0};
  b.vehicle.around.stock = watch;
  b.vehicle.around.stock_context = &seen;
  call(&b, 7);
  CHECK(seen.calls == 0);
  b.vehicle.app.shadow = 1;
  call(&b, 1);
  CHECK(seen.calls == 2 && seen.nothing_in_all == 1);
  CHECK(seen.step == 7 && seen.thrust == 40000.0f);
  call(&b, 10);
  CHECK(seen.calls == 12 && seen.nothing_in_all == 1 && seen.step == 17);
}

TEST(app_commands_a_part_of_both_on_the_way_and_then_what_the_stock_controller_does) {
  static border_t b;
  start(&b);
  stock_seen_t seen = {.calls = 0};
  b.vehicle.around.stock = watch;
  b.vehicle.around.stock_context = &seen;
  b.vehicle.app.shadow = 1;
  float stock_N[MOTORS];
  units_applied(stock_N, &STOCK);
  for (int ms = 1; ms < 1000; ms++) {
    ROW("call %d", ms);
    call(&b, 1);
    CHECK(b.control.controlMode == controlModeForce);
    for (int i = 0; i < MOTORS; i++) {
      const float own_N = b.vehicle.app.flight.out.motors.force_N[i];
      const double want_N = (double)own_N + 0.001 * ms * (double)(stock_N[i] - own_N);
      CHECK_NEAR(0.12f * b.control.normalizedForces[i], want_N, 1e-5);
    }
  }
  call(&b, 2);
  CHECK(b.control.controlMode == controlModeLegacy && b.control.thrust == STOCK.thrust);
  CHECK(b.control.roll == STOCK.roll && b.control.pitch == STOCK.pitch && b.control.yaw == STOCK.yaw);
}

TEST(app_that_is_not_flyable_stops_its_motors_whatever_they_did_and_whoever_flies) {
  for (int shadow = 0; shadow < 2; shadow++) {
    ROW("shadow %d", shadow);
    static border_t b;
    start(&b);
    b.vehicle.app.shadow = (uint8_t)shadow;
    call(&b, 9);
    b.control = (control_t){.controlMode = controlModeForce, .normalizedForces = {0.5f, 0.5f, 0.5f, 0.5f}};
    b.vehicle.app.flyable.not_flyable = FLYABLE_TURN_X;
    call(&b, 1);
    for (int i = 0; i < MOTORS; i++) CHECK(b.control.normalizedForces[i] == 0.0f);
    CHECK(b.control.controlMode == controlModeForce && b.vehicle.app.in.setpoint.thrust_N == 0.0f);
    CHECK(b.vehicle.app.recorder.calls == 10); // that call is recorded, too
  }
}
