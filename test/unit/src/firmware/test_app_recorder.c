// test_app_recorder.c - when the app has the uSD deck write a row of the estimate and one of the set point.
#include "crazyflie/crazyflie.h"
#include "firmware/recorder.h"
#include "rig/test.h"

#include <string.h>

typedef struct {
  crazyflie_t vehicle;
  int calls, states, sets; // rows of each event
} deck_t;

static void take(void *context, const char *event) {
  deck_t *const d = context;
  d->calls += strcmp(event, "indiCall") == 0;
  d->states += strcmp(event, "indiState") == 0;
  d->sets += strcmp(event, "indiSet") == 0;
}

// Calls of a vehicle whose inputs change only where a test changes them.
static void rest(deck_t *d, int calls) {
  stand_in = &d->vehicle.around;
  for (; calls > 0; calls--) recorder_call();
}

// A deck that has written its first rows.
static void start(deck_t *d) {
  *d = (deck_t){.calls = 0};
  crazyflie_init(&d->vehicle, NULL);
  crazyflie_start(&d->vehicle);
  d->vehicle.around.event = take;
  d->vehicle.around.event_context = d;
  d->vehicle.app.in.range_m = 0.5f;
  d->vehicle.app.in.range_age_s = 0.07f;
  rest(d, 1);
  CHECK(d->calls == 1 && d->states == 1 && d->sets == 1);
}

// --- what changes -----------------------------------------------------------------------------------------

static const struct {
  const char *what;
  size_t at; // in flight_in_t: a float
  float other;
} number[] = {
    {"x", offsetof(flight_in_t, pos_w_m.x), 0.1f},
    {"y", offsetof(flight_in_t, pos_w_m.y), -1e-30f},
    {"z", offsetof(flight_in_t, pos_w_m.z), NAN},
    {"climb", offsetof(flight_in_t, vel_w_mps.z), 0.2f},
    {"a zero of another sign", offsetof(flight_in_t, vel_w_mps.x), -0.0f},
    {"speed along y", offsetof(flight_in_t, vel_w_mps.y), -3.0f},
    {"attitude w", offsetof(flight_in_t, q_wb.w), 0.5f},
    {"attitude x", offsetof(flight_in_t, q_wb.x), 0.5f},
    {"attitude y", offsetof(flight_in_t, q_wb.y), 0.5f},
    {"attitude z", offsetof(flight_in_t, q_wb.z), 0.5f},
    {"range", offsetof(flight_in_t, range_m), 0.499f},
    {"a range that is no number", offsetof(flight_in_t, range_m), NAN},
    {"age of the range", offsetof(flight_in_t, range_age_s), 0.09f},
};

// One row in the call of the change, none after it.
static void check_one_state_row(deck_t *d) {
  rest(d, 1);
  CHECK_NEAR(d->states, 2, 0);
  rest(d, 9);
  CHECK_NEAR(d->states, 2, 0);
  CHECK(d->vehicle.app.recorder.state == 2 && d->calls == 11);
}

TEST(app_records_the_estimate_and_the_range_once_when_one_number_of_them_changes) {
  for (unsigned i = 0; i < sizeof number / sizeof *number; i++) {
    ROW("%s", number[i].what);
    static deck_t d;
    start(&d);
    memcpy((char *)&d.vehicle.app.in + number[i].at, &number[i].other, sizeof(float));
    check_one_state_row(&d);
    CHECK(d.sets == 1);
  }
}

TEST(app_records_the_estimate_once_when_what_stands_beside_it_changes) {
  static deck_t d;
  ROW("no lesson");
  start(&d);
  d.vehicle.app.in.no_lesson = !d.vehicle.app.in.no_lesson;
  check_one_state_row(&d);
  ROW("another set of parameters");
  start(&d);
  d.vehicle.app.recorder.tunes++;
  check_one_state_row(&d);
  ROW("velocities along the heading");
  start(&d);
  d.vehicle.app.in.setpoint.vel_in_body = true;
  check_one_state_row(&d);
  CHECK(d.sets == 2);
}

TEST(app_records_a_set_point_once_when_it_changes) {
  static const flight_setpoint_t other[] = {
      {.z = AXIS_POSITION},       {.yaw = YAW_RATE},        {.pos_w_m = {.y = 0.1f}},
      {.vel_mps = {.x = 1.0f}},   {.acc_w_mps2 = {.z = 1}}, {.roll_rad = 0.1f},
      {.pitch_rad = NAN},         {.thrust_N = 0.3f},       {.yaw_rad = -0.0f},
      {.yaw_rate_radps = 1e-30f},
  };
  for (unsigned i = 0; i < sizeof other / sizeof *other; i++) {
    ROW("set point %u", i);
    static deck_t d;
    start(&d);
    d.vehicle.app.in.setpoint = other[i];
    rest(&d, 1);
    CHECK_NEAR(d.sets, 2, 0);
    rest(&d, 9);
    CHECK_NEAR(d.sets, 2, 0);
    CHECK(d.vehicle.app.recorder.set == 2 && d.states == 1);
  }
}

// --- at rest ----------------------------------------------------------------------------------------------

TEST(app_records_a_vehicle_at_rest_anew_in_every_hundredth_call) {
  static deck_t d;
  start(&d);
  for (int call = 2; call <= 1001; call++) {
    ROW("call %d", call);
    rest(&d, 1);
    CHECK_NEAR(d.states, 1 + call / RECORDER_ANEW_MS, 0);
    CHECK_NEAR(d.sets, 1 + call / RECORDER_ANEW_MS, 0);
  }
  CHECK_NEAR(d.calls, 1001, 0);
  CHECK(d.vehicle.app.recorder.calls == 1001);
}

TEST(app_records_anew_in_a_call_in_which_no_loop_runs) {
  static deck_t d;
  start(&d);
  d.vehicle.app.flight.due = FLIGHT_INNER;
  rest(&d, RECORDER_ANEW_MS + 1);
  CHECK(d.states == 1 && d.sets == 1);
  d.vehicle.app.flight.due = 0;
  rest(&d, 1);
  CHECK(d.states == 2 && d.sets == 2);
  rest(&d, RECORDER_ANEW_MS - 4);
  CHECK(d.states == 2 && d.sets == 2);
  rest(&d, 1);
  CHECK(d.states == 3 && d.sets == 3);
}

TEST(app_records_all_at_once_where_a_deck_begins_and_nothing_without_one) {
  static deck_t d;
  start(&d);
  d.vehicle.app.flight.due = FLIGHT_INNER; // it does not wait for a call that has the time
  d.vehicle.around.event = NULL;
  rest(&d, 1);
  d.vehicle.app.in.range_m = 0.4f;
  rest(&d, 1);
  CHECK(d.calls == 1 && d.vehicle.app.recorder.state == 1 && d.vehicle.app.recorder.calls == 3);
  d.vehicle.around.event = take;
  rest(&d, 5);
  CHECK(d.calls == 6 && d.states == 2 && d.sets == 2);
}

TEST(app_counts_its_calls_to_the_largest_number_and_stops) {
  static deck_t d;
  start(&d);
  d.vehicle.app.recorder.calls = UINT32_MAX - 2;
  rest(&d, 1);
  CHECK(d.vehicle.app.recorder.calls == UINT32_MAX - 1);
  rest(&d, 2);
  CHECK(d.vehicle.app.recorder.calls == UINT32_MAX);
}
