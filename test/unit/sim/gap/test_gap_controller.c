// test_gap_controller.c - nominal flights by the controller that the vehicle file names: it does with
// noise what it did in the log.
#include "base/by_size.h"
#include "base/random.h"
#include "exam/flights.h"
#include "gap/2_predict/lines.h"
#include "gap/diagnose.h"
#include "rig/gap_logs.h"
#include "rig/programs.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  model_t vehicle;
  gap_flight_t flight;
  set_t set;
  closed_loop_t loop;
} rig_t;

static void residual_room(const set_t *s, double *residual[CHANNELS]) {
  for (int ch = 0; ch < CHANNELS; ch++) residual[ch] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
}

// A flight in which nothing is hidden.
static done_t rig_make(rig_t *r, bool indi, why_t *why) {
  grid_t *const grid = calloc(2, sizeof *grid);
  double *residual[CHANNELS];
  *r = (rig_t){.set = {.n_grid = 0}};
  TRY(exam_vehicle(&r->vehicle, why));
  const exam_flight_t job = {.truth = &r->vehicle, .indi = indi, .seed = 52003};
  TRY(exam_fly(&job, &r->flight, why));
  TRY(grid_make(&grid[0], &r->flight, 0, r->flight.n, &r->vehicle, why));
  TRY(set_make(&r->set, grid, 1, why));
  residual_room(&r->set, residual);
  TRY(residual_of(&r->set, &r->vehicle, residual, why));
  TRY(closed_loop_of(&r->loop, &r->set, &r->vehicle, NULL, residual, why));
  for (int ch = 0; ch < CHANNELS; ch++) free(residual[ch]);
  return DONE;
}

typedef enum { GUSTS, NEW_AT_EACH_ROW, WANDERS, STEP } turning_t;

// By row of the turning: first order, 2 rad/s2 of 0.3 s; white, 2 rad/s2; another moment every 4 s, 2 rad/s2;
// or nothing, and 8 rad/s2 from 7 s before the end on.
static void put_turning(const rig_t *r, turning_t what, double *const residual[CHANNELS]) {
  const rows_t *const rows = &r->set.smooth;
  const double keep = what == GUSTS ? exp(-1.0 / RESIDUAL_HZ / 0.3) : 0.0,
               fresh = 2.0 * sqrt(1.0 - keep * keep);
  random_t *const random = random_open(11);
  for (int ch = CH_WX; ch < CH_SMOOTH; ch++) {
    double now = 0.0;
    for (int i = 0; i < rows->n; i++) {
      now = keep * now + fresh * random_normal(random);
      residual[ch][i] = what == WANDERS ? (rows->block[i] - rows->block[0]) / 2 % 2 ? -1.0 : 1.0
                        : what != STEP  ? now
                        : i < rows->n - (int)(7.0 * RESIDUAL_HZ) ? 0.0
                                                                 : 8.0;
    }
  }
  random_close(random);
}

// A log of 10 s has three stretches: what begins is in most of their changes.
TEST(gap_takes_no_moment_that_begins_and_stays_for_a_disturbance) {
  static const struct {
    const char *what;
    turning_t turning;
    double span_s, turn_radps2, error_radps2, quick, tau_s, most_s;
  } row[] = {{"gusts", GUSTS, 60.0, 2.0, 0.6, 0.0, 0.2, 0.4},
             {"new at each row", NEW_AT_EACH_ROW, 60.0, 2.0, 0.2, 1.0, 0.05, 0.06},
             {"another every 4 s", WANDERS, 60.0, 2.1, 0.1, 0.0, 45.0, 70.0},
             {"a step", STEP, 60.0, 0.0, 0.01, 0.0, 0.0, 60.0},
             {"a step in a short log", STEP, 10.0, 0.0, 0.01, 0.0, 0.0, 60.0}};
  rig_t r;
  why_t why = {""};
  double *residual[CHANNELS];
  if (!CHECK_OK(rig_make(&r, false, &why))) return;
  residual_room(&r.set, residual);
  const int all = r.set.smooth.n;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    r.set.smooth.n = (int)fmin(all, row[i].span_s * RESIDUAL_HZ);
    put_turning(&r, row[i].turning, residual);
    closed_loop_t loop;
    CHECK_OK(closed_loop_of(&loop, &r.set, &r.vehicle, NULL, residual, &why));
    for (int k = 0; k < 3; k++) {
      CHECK_NEAR(loop.turn_radps2[k], row[i].turn_radps2, row[i].error_radps2);
      CHECK_NEAR(loop.turn_quick[k], row[i].quick, 0.3);
    }
    CHECK(loop.turn_tau_s >= row[i].tau_s && loop.turn_tau_s < row[i].most_s);
  }
  r.set.smooth.n = all;
  for (int ch = 0; ch < CHANNELS; ch++) free(residual[ch]);
  set_free(&r.set);
  gap_flight_free(&r.flight);
}

// Nothing else shakes it, so that the rows have what the loop says, lasting or new at each step.
TEST(gap_nominal_flights_are_turned_by_as_much_as_rows_show) {
  for (int quick = 0; quick < 2; quick++) {
    rig_t r;
    why_t why = {""};
    along_t a;
    lines_t l;
    ROW("%s", quick ? "new at each step" : "lasting");
    if (!CHECK_OK(rig_make(&r, false, &why))) return;
    closed_loop_t *const w = &r.loop;
    for (int k = 0; k < 3; k++) {
      w->turn_radps2[k] = 1.0;
      w->turn_quick[k] = quick;
      w->gyro_radps[k] = w->force_mps2[k] = w->quick_mps2[k] = 0.0;
    }
    w->turn_tau_s = 0.3;
    if (!CHECK_OK(nominal_along(&a, &r.set, &r.vehicle, w, 77, &why))) return;
    CHECK_OK(residual_lines(&a.is, &r.vehicle, &l, &why));
    for (int ch = CH_WX; ch < CH_SMOOTH; ch++) {
      double squares = 0.0;
      for (int i = 0; i < a.is.smooth.n; i++) squares += l.r[ch][i] * l.r[ch][i];
      CHECK_NEAR(sqrt(squares / a.is.smooth.n), 1.0, quick ? 0.12 : 0.25);
    }
    lines_free(&l);
    along_free(&a);
    set_free(&r.set);
    gap_flight_free(&r.flight);
  }
}

// The last one is more than its motors follow.
TEST(gap_leads_a_nose_as_much_as_what_is_left_goes_with_its_turning) {
  static const double goes_per_s[] = {0.0, 1.0, -1.0, 1000.0};
  rig_t r;
  why_t why = {""};
  double *residual[CHANNELS];
  if (!CHECK_OK(rig_make(&r, false, &why))) return;
  residual_room(&r.set, residual);
  for (unsigned k = 0; k < sizeof goes_per_s / sizeof *goes_per_s; k++) {
    for (int i = 0; i < r.set.smooth.n; i++)
      residual[CH_WZ][i] = goes_per_s[k] * r.set.grid[0].point[r.set.smooth.point[i]].rate_b_radps.z;
    closed_loop_t loop;
    CHECK_OK(closed_loop_of(&loop, &r.set, &r.vehicle, NULL, residual, &why));
    const double gain_per_s = loop.rate_gain[2];
    ROW("%g 1/s: %g of %g 1/s", goes_per_s[k], loop.nose_lead, gain_per_s);
    if (goes_per_s[k] < 1000.0)
      CHECK_NEAR(loop.nose_lead, fabs(goes_per_s[k]) / gain_per_s, 1e-9);
    else
      CHECK_NEAR(loop.nose_lead, 1.672, 1e-3);
    CHECK((1.0 + loop.nose_lead) * gain_per_s < loop.rate_gain_most);
  }
  for (int ch = 0; ch < CHANNELS; ch++) free(residual[ch]);
  set_free(&r.set);
  gap_flight_free(&r.flight);
}

// Median of what a motor's command changes from sample to sample: noise that the controller fed back.
static double restless_N(const gap_flight_t *f) {
  double *const step_N = malloc((size_t)f->n * sizeof *step_N);
  if (!step_N) abort();
  for (int i = 1; i < f->n; i++) step_N[i - 1] = fabs(f->v[SIG_M1][i] - f->v[SIG_M1][i - 1]);
  qsort(step_N, (size_t)f->n - 1, sizeof *step_N, by_size);
  const double median_N = step_N[f->n / 2];
  free(step_N);
  return median_N;
}

static double nominal_restless_N(const rig_t *r, flown_by_kind_t kind) {
  gap_flight_t flown;
  why_t why = {""};
  closed_loop_t loop = r->loop;
  const flown_by_t by = {.kind = kind, .pid = stock_pid_default()};
  loop.flown_by = &by;
  if (!CHECK_OK(nominal_fly(&r->set.grid[0], &r->vehicle, &loop, 5, &flown, NULL, &why))) return 0.0;
  const double median_N = restless_N(&flown);
  gap_flight_free(&flown);
  return median_N;
}

TEST(gap_nominal_flights_by_the_log_s_controller_feed_noise_back_as_it_does) {
  static const struct {
    const char *what;
    bool indi;
    flown_by_kind_t kind;
  } row[] = {{"firmware's PID", false, FLOWN_BY_STOCK_PID}, {"flight code", true, FLOWN_BY_INDI}};
  for (int i = 0; i < 2; i++) {
    rig_t r;
    why_t why = {""};
    ROW("%s", row[i].what);
    if (!CHECK_OK(rig_make(&r, row[i].indi, &why))) return;
    const double real_N = restless_N(&r.flight), known_N = nominal_restless_N(&r, row[i].kind),
                 fitted_N = nominal_restless_N(&r, FLOWN_BY_UNKNOWN);
    CHECK_NEAR(known_N / real_N, 1.0, 0.3); // its noise and its disturbance are estimates
    // One that is fitted has a lead as a PID has, and no filter as the flight code has.
    if (row[i].indi)
      CHECK(fabs(fitted_N - real_N) > fabs(known_N - real_N));
    else
      CHECK_NEAR(fitted_N / real_N, 1.0, 0.3);
    set_free(&r.set);
    gap_flight_free(&r.flight);
  }
}

// Samples in which all motors keep the command that they had.
static double share_held(const gap_flight_t *f) {
  int held = 0;
  for (int i = 1; i < f->n; i++) {
    bool same = true;
    for (int k = SIG_M1; k <= SIG_M4; k++) same = same && f->v[k][i] == f->v[k][i - 1];
    held += same;
  }
  return (double)held / (f->n - 1);
}

TEST(gap_nominal_flights_hold_each_command_as_long_as_the_vehicle_file_s_controller_does) {
  rig_t r;
  why_t why = {""};
  if (!CHECK_OK(rig_make(&r, true, &why))) return;
  for (int each = 1; each <= 4; each *= 2) {
    ROW("a command in %d samples", each);
    gap_flight_t flown;
    const flown_by_t by = {.kind = FLOWN_BY_OTHER, .rate_Hz = r.flight.rate_Hz / each};
    r.loop.flown_by = &by;
    if (!CHECK_OK(nominal_fly(&r.set.grid[0], &r.vehicle, &r.loop, 5, &flown, NULL, &why))) continue;
    CHECK_NEAR(share_held(&flown), 1.0 - 1.0 / each, 0.01);
    gap_flight_free(&flown);
  }
  set_free(&r.set);
  gap_flight_free(&r.flight);
}

TEST(gap_takes_a_log_as_quick_if_it_has_every_command_of_the_vehicle_file_s_controller) {
  static const struct {
    double rate_Hz, command_Hz;
    bool slow;
  } row[] = {{500.0, 0.0, false},  {100.0, 0.0, true},  {100.0, 100.0, false},
             {99.0, 100.0, false}, {90.0, 100.0, true}, {250.0, 500.0, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_flight_t flight = {.rate_Hz = row[i].rate_Hz};
    grid_t grid = {.flight = &flight, .command_Hz = row[i].command_Hz};
    const set_t s = {.grid = &grid, .n_grid = 1};
    ROW("%g Hz of %g Hz", row[i].rate_Hz, row[i].command_Hz);
    CHECK(candidates_slow(&s) == row[i].slow);
  }
}

TEST(gap_flies_nominal_flights_by_the_vehicle_file_s_controller_and_keeps_it) {
  char text[6000];
  CHECK(gap_logs_fly("own", 3, NULL));
  CHECK(program_run("cp $S/room.toml $S/own.toml; printf '\\n[controller]\\nkind = \"stock-pid\"\\n"
                    "pid_rate.roll_kp = 250\\n' >>$S/own.toml; gap --vehicle $S/own.toml --columns "
                    "tools/columns/fly.toml --out $S/own $S/own?.csv",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "Nothing is missing in own.toml that these flights could show.\n") != NULL);
  CHECK(program_run("grep -A2 controller $S/own/model.toml; fly hand-held --vehicle $S/own/model.toml",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "[controller]\nkind = \"stock-pid\"\npid_rate.roll_kp = 250\n") != NULL);
}

TEST(gap_cannot_tell_where_the_vehicle_file_s_controller_does_not_fly_it) {
  char text[6000];
  CHECK(gap_logs_fly("odd", 2, NULL));
  CHECK(program_run("cp $S/room.toml $S/odd.toml; printf '\n[controller]\nkind = \"stock-pid\"\n"
                    "posCtlPid.thrustBase = 0\nposCtlPid.thrustMin = 0\nvelCtlPid.vzKp = 0\n"
                    "velCtlPid.vzKi = 0\n' >>$S/odd.toml; "
                    "gap --vehicle $S/odd.toml --columns tools/columns/fly.toml $S/odd?.csv",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "These flights cannot tell what is missing in odd.toml.\n") != NULL);
  CHECK(strstr(text, "note: the model could not be flown along these tracks") != NULL);
}

// What an accelerometer that filters has between its samples may be a force, which shakes who flies. Taken
// for noise of the sensor it left nominal flights calm, and what this controller makes of it was told as a
// thrust_slope beside the ceiling that the vehicle file lacks.
TEST(gap_names_nothing_that_control_makes_of_what_is_between_two_samples) {
  char text[6000];
  CHECK(program_run(
            "for s in 201 202 203; do fly test-flight --effect mass:add=0.001 --seed $s --integrator rk4 "
            "--log $S/q$s.csv >/dev/null; done; gap $S/q20?.csv",
            STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "Something is missing in ") != NULL && strstr(text, "\nunknown: ") != NULL);
}
