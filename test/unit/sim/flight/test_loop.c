// test_loop.c - the loop in six degrees of freedom: what the pilot is told, and what is recorded.
#define _POSIX_C_SOURCE 200809L // nanosleep
#include "flight/loop.h"
#include "flight/segments.h"
#include "rig/vehicle6.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

#define CEILING_M 0.5
#define LIMIT_N   0.15 // of a motor of vehicle6()
#define UP_AGE_MS 70   // of an upward sample, between the least and the greatest

// A pilot that always wants the same, and looks.
typedef struct {
  double motor_N;
  d3_t gyro_most;
  double applied_N; // largest told
  double at_m[256]; // true distance to the ceiling, of the last milliseconds
  int ms, ranges;
  double ceiling_z_m;   // thought
  double late_m, now_m; // sum of |range - true distance|: when it was measured, and when it came
} still_t;

static void still_step(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  still_t *const s = state;
  for (int i = 0; i < PILOT_MOTORS; i++) {
    motor_N[i] = s->motor_N;
    s->applied_N = fmax(s->applied_N, in->applied_N[i]);
  }
}

static void still_reset(void *state) {
  (void)state;
}

// Compares the sample with what was true UP_AGE_MS before.
static void watch(void *context, const body_t *truth, pilot_in_t *in) {
  still_t *const s = context;
  s->at_m[s->ms % 256] = body_ceiling_gap_m(truth, 0);
  if (in->range_new && s->ms >= 256) {
    s->late_m += fabs(in->range_m - s->at_m[(s->ms - UP_AGE_MS) % 256]);
    s->now_m += fabs(in->range_m - s->at_m[s->ms % 256]);
    s->ranges++;
  }
  s->ms++;
}

typedef struct {
  record_t record;
  outcome_t outcome;
  plan_t plan;
} watched_t;

// From 0.1 m, climbing at climb_mps; two set points, 0.4 m and from half the time on 0.45 m.
static done_t fly_with(loop_edit_t edit, still_t *s, double climb_mps, double end_s, watched_t *flown,
                       model_t *model, why_t *why) {
  const double f = 0.25 * WEIGHT_N;
  *flown = (watched_t){
      .plan = {
          .way = {{0.0, 0.4}, {0.5 * end_s, 0.45}},
          .n_way = 2,
          .end_s = end_s,
          .start = {.pos_w_m = {0.0, 0.0, 0.1}, .vel_w_mps = {0.0, 0.0, climb_mps}, .thrust_N = {f, f, f, f}},
          .in_flight = true,
          .edit = edit,
          .edit_context = s}};
  flown->plan.integrate = INTEGRATE_RK4;
  const pilot_t pilot = {.state = s, .step = still_step, .reset = still_reset};
  return loop_fly(&flown->plan, model, &pilot, &flown->record, &flown->outcome, why);
}

static done_t fly(still_t *s, double climb_mps, double end_s, watched_t *flown, model_t *model, why_t *why) {
  return fly_with(watch, s, climb_mps, end_s, flown, model, why);
}

static void drop(watched_t *flown) {
  record_free(&flown->record);
}

TEST(loop_counts_a_contact_that_lasts_in_each_segment) {
  // The top is 8 mm above the rotors: the record's gap never comes to 0.
  model_t m = vehicle6(CEILING_M);
  m.frame.top_above_rotor_m = 0.008;
  still_t s = {.motor_N = 1.3 * 0.25 * WEIGHT_N};
  watched_t flown;
  why_t why;
  segment_t segment[WAYPOINTS_MAX];
  if (!CHECK_OK(fly(&s, 0.0, 6.0, &flown, &m, &why))) return;
  CHECK(segments_of(&flown.record, &flown.plan, segment) == 2);
  CHECK(segment[0].contacts >= 1); // it may bounce
  CHECK(segment[1].contacts == 1);
  CHECK_NEAR(flown.record.sample[flown.record.n - 1].gap_m, 0.008, 1e-4);
  drop(&flown);
}

// As if another program had the processor for half a second.
static void sleep_once(void *context, const body_t *truth, pilot_in_t *in) {
  still_t *const s = context;
  (void)truth, (void)in;
  if (s->ms++ == 0) nanosleep(&(struct timespec){.tv_nsec = 500000000}, NULL);
}

TEST(loop_counts_its_own_time_on_the_processor_and_no_other) {
  model_t m = vehicle6(HUGE_VAL);
  still_t s = {.motor_N = 0.25 * WEIGHT_N};
  watched_t flown;
  why_t why;
  if (!CHECK_OK(fly_with(sleep_once, &s, 0.0, 0.5, &flown, &m, &why))) return;
  // By the wall clock it would be below 1; even under sanitizers the loop itself is ten times as fast.
  CHECK(flown.outcome.realtime_factor > 2.0 && isfinite(flown.outcome.realtime_factor));
  drop(&flown);
}

TEST(loop_tells_the_pilot_what_was_applied_and_not_what_it_asked_for) {
  model_t m = vehicle6(HUGE_VAL);
  still_t s = {.motor_N = 1.0};
  watched_t flown;
  why_t why;
  if (!CHECK_OK(fly(&s, 0.0, 0.1, &flown, &m, &why))) return;
  CHECK_NEAR(s.applied_N, LIMIT_N, 1e-12);
  drop(&flown);
}

TEST(loop_records_what_was_applied_since_the_last_call_beside_the_new_command) {
  model_t m = vehicle6(HUGE_VAL);
  still_t s = {.motor_N = 1.0};
  watched_t flown;
  why_t why;
  if (!CHECK_OK(fly(&s, 0.0, 0.1, &flown, &m, &why))) return;
  for (int i = 0; i < 2; i++) {
    ROW("sample %d", i);
    CHECK_NEAR(flown.record.sample[i].command_N, PILOT_MOTORS * 1.0, 1e-12);
    CHECK_NEAR(flown.record.sample[i].sense.applied_N, i == 0 ? WEIGHT_N : PILOT_MOTORS * LIMIT_N, 1e-12);
  }
  drop(&flown);
}

TEST(loop_tells_how_old_a_range_sample_is) {
  // In a climb at 0.2 m/s a sample of 60 to 80 ms is 14 mm off when it comes, at most 2 mm when it was
  // measured.
  model_t m = vehicle6(CEILING_M);
  still_t s = {.motor_N = 0.25 * WEIGHT_N};
  watched_t flown;
  why_t why;
  if (!CHECK_OK(fly(&s, 0.2, 1.5, &flown, &m, &why))) return;
  if (!CHECK(s.ranges >= 10)) return;
  CHECK_NEAR(s.now_m / s.ranges, 0.014, 0.002);
  CHECK(s.late_m / s.ranges < 0.002);
  drop(&flown);
}

TEST(loop_says_whose_fault_it_is_that_it_does_not_fly) {
  model_t m = vehicle6(HUGE_VAL);
  snprintf(m.name, sizeof m.name, "stone");
  m.frame.kf_Ns2 = 0.0;
  still_t s = {0};
  watched_t flown;
  why_t why;
  CHECK_STATUS(BAD_INPUT, fly(&s, 0.0, 0.1, &flown, &m, &why));
  CHECK_TEXT(why.text, "vehicle stone with its effects: mass, inertia, motor lag or kf not above 0; such a "
                       "vehicle cannot fly");
}

TEST(loop_records_every_tick_where_it_is_asked_to) {
  model_t m = vehicle6(CEILING_M);
  still_t s = {.motor_N = 0.25 * WEIGHT_N};
  watched_t flown;
  why_t why;
  if (!CHECK_OK(fly(&s, 0.0, 0.1, &flown, &m, &why))) return;
  CHECK(flown.record.n == 11);
  plan_t every = flown.plan;
  drop(&flown);
  every.record_every = 1;
  const pilot_t pilot = {.state = &s, .step = still_step, .reset = still_reset};
  CHECK_OK(loop_fly(&every, &m, &pilot, &flown.record, &flown.outcome, &why));
  CHECK(flown.record.n == 51);
  CHECK_NEAR(flown.record.sample[50].t_s, 0.1, 1e-12);
  drop(&flown);
}

static void think(const void *state, thoughts_t *thoughts) {
  thoughts->ceiling_z_m = ((const still_t *)state)->ceiling_z_m;
}

TEST(loop_counts_set_points_from_the_ceiling_that_the_pilot_thinks) {
  static const struct {
    const char *what;
    bool below_estimate;
    double ceiling_z_m, want_m; // set point: 0.1 m below it; NaN: 0.4 m, less the height of what stands
  } row[] = {{"as it is", false, 0.44, (double)NAN},
             {"as it is thought", true, 0.44, 0.34},
             {"none is thought", true, (double)NAN, (double)NAN}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    model_t m = vehicle6(CEILING_M);
    still_t s = {.motor_N = 0.25 * WEIGHT_N, .ceiling_z_m = row[i].ceiling_z_m};
    watched_t flown;
    why_t why;
    if (!CHECK_OK(fly(&s, 0.0, 0.1, &flown, &m, &why))) return;
    drop(&flown);
    plan_t plan = flown.plan;
    plan.n_way = 1;
    plan.below_estimate = row[i].below_estimate;
    const pilot_t pilot = {.state = &s, .step = still_step, .reset = still_reset, .tell = think};
    CHECK_OK(loop_fly(&plan, &m, &pilot, &flown.record, &flown.outcome, &why));
    const double want_m = isnan(row[i].want_m) ? 0.4 - m.frame.rotor_above_feet_m : row[i].want_m;
    CHECK_NEAR(flown.record.sample[5].setpoint_z_m, want_m, 1e-12);
    drop(&flown);
  }
}

TEST(loop_logs_the_latched_height_of_the_ceiling_and_what_the_guard_says) {
  const thoughts_t thoughts = {.zc_m = 0.125, .ceiling_z_m = 0.3125, .guard_now = 64, .guard_latched = 68};
  sample_t sample = {.sense = {.z_m = 0.25}, .thoughts = thoughts};
  const record_t record = {.sample = &sample, .n = 1};
  char text[3000] = "";
  FILE *file = tmpfile();
  if (!CHECK(file != NULL)) return;
  record_write(&record, file);
  rewind(file);
  CHECK(fread(text, 1, sizeof text - 1, file) > 0);
  fclose(file);
  const char *names = strstr(text, "ceil.zc,ceil.height,guard.now,guard.latched,");
  if (!CHECK(names != NULL)) return;
  int column = 0;
  for (const char *c = text; c < names; c++) column += *c == ',';
  const char *cell = strchr(text, '\n');
  for (int i = 0; cell && i < column; i++) cell = strchr(cell + 1, ',');
  CHECK(cell && strncmp(cell, ",0.125000,0.312500,64,68,", 25) == 0);
}
