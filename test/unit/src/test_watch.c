// test_watch.c - the time between two calls, which loops it makes due, and which set points are none.
#include "flight/bounds.h"
#include "flight/watch.h"
#include "rig/test.h"

#include <string.h>

static flight_t fresh(void) {
  flight_param_t p;
  params_default(&p);
  flight_t f;
  CHECK_OK(flight_init(&f, &p));
  return f;
}

// Called so that its phase is this one, with nothing due.
static flight_t at_phase(unsigned phase) {
  flight_t f = fresh();
  CHECK(watch_time(&f, 1000 + phase));
  f.step_last = 1000 + phase; // as the guard does when it has read the time
  return f;
}

// --- time -------------------------------------------------------------------------------------------------

TEST(watch_begins_with_the_inner_loop_and_a_millisecond) {
  flight_t f = fresh();
  CHECK(watch_time(&f, 4711));
  CHECK(f.called && f.phase == 1 && f.due == FLIGHT_INNER && f.inner_ms == 2 && f.step_last == 4710);
  CHECK(f.guard.latched == 0);
}

TEST(watch_takes_a_long_pause_for_a_short_one_and_time_that_runs_backwards_for_a_millisecond) {
  static const struct {
    uint32_t since;
    int ms; // that it is taken for; 0: the call was here already
    bool odd;
  } row[] = {{1, 1, false},          {2, 2, true},     {49, 49, true},          {50, 50, true},
             {51, 50, true},         {5000, 50, true}, {0x7fffffffu, 50, true}, {0x80000000u, 1, true},
             {0xffffffffu, 1, true}, {0, 0, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%u ms", (unsigned)row[i].since);
    flight_t f = at_phase(3);
    const uint32_t step = f.step_last + row[i].since;
    CHECK(watch_time(&f, step) == (row[i].ms > 0));
    CHECK(((f.guard.latched & GUARD_TIME) != 0) == row[i].odd);
    CHECK_NEAR(f.inner_ms, 2 + row[i].ms, 0);
    CHECK_NEAR(f.phase, (3 + row[i].ms) % 10, 0);
    if (row[i].ms > 0) CHECK_NEAR(step - f.step_last, row[i].ms, 0);
  }
}

TEST(watch_tells_the_outer_loop_of_periods_that_were_skipped_altogether) {
  static const struct {
    unsigned phase;
    uint32_t ms;
    unsigned missed;
  } row[] = {{0, 19, 0}, {0, 20, 1}, {9, 10, 0}, {9, 11, 1}, {0, 29, 1}, {0, 30, 2}, {5, 50, 4}, {5, 500, 4}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%u ms from phase %u", (unsigned)row[i].ms, row[i].phase);
    flight_t f = at_phase(row[i].phase);
    CHECK(watch_time(&f, f.step_last + row[i].ms));
    CHECK_NEAR(f.outer.missed, row[i].missed, 0);
  }
}

TEST(watch_counts_the_time_of_the_inner_loop_up_to_a_second) {
  static const struct {
    int before, after;
  } row[] = {{0, 10}, {990, 1000}, {999, 1009}, {1000, 1000}, {1009, 1000}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d ms", row[i].before);
    flight_t f = at_phase(0);
    f.inner_ms = row[i].before;
    CHECK(watch_time(&f, f.step_last + 10));
    CHECK_NEAR(f.inner_ms, row[i].after, 0);
  }
}

TEST(watch_takes_the_phase_from_the_counter_where_a_bit_of_it_flipped) {
  for (unsigned flipped = 8; flipped < 20; flipped++) {
    ROW("phase %u", flipped);
    flight_t f = at_phase(3);
    f.phase = flipped;
    CHECK(watch_time(&f, f.step_last + 1));
    CHECK_NEAR(f.phase, flipped > 9 ? 4 : (flipped + 1) % 10, 0);
  }
}

// --- loops ------------------------------------------------------------------------------------------------

// All that falls into these milliseconds. After missed calls the inner loop is due in any case, and the
// ground's curve is not: it comes alone or not at all.
static unsigned due_in(unsigned phase, unsigned ms) {
  unsigned due = ms > 1 ? FLIGHT_INNER : phase == 5 ? FLIGHT_GROUND : 0;
  for (unsigned at = phase + 1; at <= phase + ms; at++) {
    due |= at % 2 == 1 ? (unsigned)FLIGHT_INNER : 0u;
    due |= at % 10 == 0 ? (unsigned)FLIGHT_OUTER : at % 10 == 4 ? (unsigned)FLIGHT_LEARN : 0u;
    due |= at % 10 == 2 ? (unsigned)FLIGHT_HEIGHT : at % 10 == 8 ? (unsigned)FLIGHT_SCRUB : 0u;
  }
  return due;
}

TEST(watch_makes_due_whatever_fell_into_the_pause) {
  for (unsigned phase = 0; phase < 10; phase++)
    for (unsigned ms = 1; ms <= 50; ms++) {
      ROW("%u ms from phase %u", ms, phase);
      flight_t f = at_phase(phase);
      CHECK(watch_time(&f, f.step_last + ms));
      CHECK((f.due | f.waiting) == due_in(phase, ms));
      CHECK((f.due & f.waiting) == 0 && (f.due & FLIGHT_INNER) == (due_in(phase, ms) & FLIGHT_INNER));
    }
}

TEST(watch_runs_one_loop_a_call_and_lets_the_others_wait) {
  enum { O = FLIGHT_OUTER, L = FLIGHT_LEARN, H = FLIGHT_HEIGHT, S = FLIGHT_SCRUB, I = FLIGHT_INNER };
  static const struct {
    unsigned phase, waiting, due,
        left; // the call after phase 5 has the ground's alone, after 0 the inner one
  } row[] = {{5, O | L | S, O, L | S},
             {5, L | S, L, S},
             {5, S, S, 0},
             {5, O | S, O, S},
             {5, 0, FLIGHT_GROUND, 0},
             {0, O | L | S, I, O | L | S},
             {0, L, I, L},
             {0, 0, I, 0},
             {9, L, O, L},
             {3, O | S, O, L | S},
             {7, 0, S, 0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("0x%x waits in phase %u", row[i].waiting, row[i].phase);
    flight_t f = at_phase(row[i].phase);
    f.waiting = row[i].waiting;
    CHECK(watch_time(&f, f.step_last + 1));
    CHECK(f.due == row[i].due && f.waiting == row[i].left);
  }
}

TEST(watch_lets_loops_that_wait_for_more_than_three_calls_run_beside_the_inner_one_in_turn) {
  static const unsigned due[] = {
      0, 0, 0, 0, FLIGHT_OUTER, FLIGHT_LEARN, FLIGHT_SCRUB, FLIGHT_HEIGHT, FLIGHT_OUTER};
  flight_t f = at_phase(8);
  for (int call = 0; call < 9; call++) {
    ROW("call %d", call);
    CHECK(watch_time(&f, f.step_last + 2)); // each costs the inner loop
    f.step_last += 2;
    CHECK(f.due == (FLIGHT_INNER | due[call]));
  }
}

TEST(watch_runs_at_most_one_loop_beside_the_inner_one_and_each_of_them_however_late_calls_are) {
  static const uint32_t late_ms[] = {2, 3, 5, 7, 9, 10, 13, 50};
  for (size_t i = 0; i < sizeof late_ms / sizeof *late_ms; i++) {
    ROW("a call every %u ms", (unsigned)late_ms[i]);
    flight_t f = at_phase(0);
    unsigned seen = 0;
    for (int call = 0; call < 40; call++) {
      CHECK(watch_time(&f, f.step_last + late_ms[i]));
      f.step_last += late_ms[i];
      const unsigned others = f.due & ~(unsigned)FLIGHT_INNER;
      CHECK((others & (others - 1u)) == 0);
      seen |= f.due;
    }
    CHECK(seen == (FLIGHT_INNER | FLIGHT_OUTER | FLIGHT_LEARN | FLIGHT_HEIGHT | FLIGHT_SCRUB));
  }
}

// --- set points -------------------------------------------------------------------------------------------

static const struct {
  const char *what;
  size_t at;
  float most;
} bound[] = {
    {"roll", offsetof(flight_setpoint_t, roll_rad), BOUND_WANTED_ANGLE_RAD},
    {"pitch", offsetof(flight_setpoint_t, pitch_rad), BOUND_WANTED_ANGLE_RAD},
    {"yaw", offsetof(flight_setpoint_t, yaw_rad), BOUND_WANTED_ANGLE_RAD},
    {"rate of yaw", offsetof(flight_setpoint_t, yaw_rate_radps), BOUND_WANTED_RATE_RADPS},
    {"thrust", offsetof(flight_setpoint_t, thrust_N), BOUND_THRUST_N},
    {"x", offsetof(flight_setpoint_t, pos_w_m.x), BOUND_POS_M},
    {"y", offsetof(flight_setpoint_t, pos_w_m.y), BOUND_POS_M},
    {"z", offsetof(flight_setpoint_t, pos_w_m.z), BOUND_POS_M},
    {"velocity x", offsetof(flight_setpoint_t, vel_mps.x), BOUND_VEL_MPS},
    {"velocity y", offsetof(flight_setpoint_t, vel_mps.y), BOUND_VEL_MPS},
    {"velocity z", offsetof(flight_setpoint_t, vel_mps.z), BOUND_VEL_MPS},
    {"acceleration x", offsetof(flight_setpoint_t, acc_w_mps2.x), BOUND_ACC_MPS2},
    {"acceleration y", offsetof(flight_setpoint_t, acc_w_mps2.y), BOUND_ACC_MPS2},
    {"acceleration z", offsetof(flight_setpoint_t, acc_w_mps2.z), BOUND_ACC_MPS2},
};

static bool good(size_t at, float value) {
  flight_setpoint_t sp = {.yaw = YAW_RATE};
  memcpy((char *)&sp + at, &value, sizeof value);
  return watch_setpoint_good(&sp);
}

TEST(watch_refuses_a_set_point_of_which_one_number_is_beyond_its_bound) {
  for (unsigned i = 0; i < sizeof bound / sizeof *bound; i++) {
    ROW("%s", bound[i].what);
    const float most = bound[i].most, over = nextafterf(most, INFINITY);
    CHECK(good(bound[i].at, most) && good(bound[i].at, -most));
    CHECK(!good(bound[i].at, over) && !good(bound[i].at, -over));
    CHECK(!good(bound[i].at, NAN) && !good(bound[i].at, INFINITY));
  }
}

// --- height -----------------------------------------------------------------------------------------------

TEST(watch_takes_no_height_for_a_jump_while_the_height_is_let_go) {
  flight_t f = fresh();
  flight_in_t in = {.q_wb = {.w = 1.0f}, .acc_b_mps2 = {.z = GRAVITY_MPS2}, .setpoint = {.yaw = YAW_RATE}};
  for (int k = 0; k < 4; k++) {
    in.step++;
    in.pos_w_m.z = (float)k;
    CHECK(watch_time(&f, in.step));
    flight_in_t seen = in;
    watch_inputs(&f, &seen);
    CHECK(seen.pos_w_m.z == (float)k && f.guard.latched == 0u);
  }
}

TEST(watch_takes_a_height_that_is_none_for_no_jump) {
  static const float height_m[] = {1.1e4f, -1e30f, INFINITY, NAN}; // a bit of it flipped
  for (unsigned i = 0; i < sizeof height_m / sizeof *height_m; i++) {
    ROW("%g m", (double)height_m[i]);
    flight_t f = fresh();
    flight_in_t in = {
        .step = 1000, .acc_b_mps2 = {.z = GRAVITY_MPS2}, .pos_w_m = {.z = 1.0f}, .q_wb = {.w = 1.0f}};
    in.setpoint.z = AXIS_POSITION;
    for (int k = 0; k < 2; k++, in.step++) {
      CHECK(watch_time(&f, in.step));
      flight_in_t now = in;
      watch_inputs(&f, &now);
      if (k == 0) f.height_m = height_m[i];
    }
    CHECK(f.height_off_m == 0.0f && !(f.guard.latched & GUARD_HEIGHT_JUMP) && f.height_m == 1.0f);
  }
}
