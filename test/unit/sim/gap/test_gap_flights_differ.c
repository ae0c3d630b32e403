// test_gap_flights_differ.c - what flights differ by is told, flight by flight, and as which effect it acts.
#include "gap/5_infer/flights_differ.h"
#include "gap/2_predict/lift.h"
#include "gap/2_predict/residual.h"
#include "gap/5_infer/loop_fit.h"
#include "gap/5_infer/nominal_sums.h"
#include "gap/5_infer/unknown.h"
#include "gap/8_report/report.h"
#include "rig/gap_track.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double more_mps2[2];

// Each flight's accelerometer starts with a bias of its own along x.
static void start_anew(gap_track_t *t) {
  for (int f = 0; f < 2; f++)
    for (int i = 0; i < t->flight[f].n; i++) t->flight[f].v[SIG_AX][i] += more_mps2[f];
}

static const would_do_t *would(const flights_differ_t *d, const char *name, int *which) {
  for (*which = 0; *which < d->as.n; (*which)++)
    if (strcmp(d->as.would[*which].use.fx->name, name) == 0) return &d->as.would[*which];
  return NULL;
}

// One nominal flight, and it is calm: 64 times its rms, 3, is chance.
#define ALONE 193.0

// statistic: of force_x, from flight to flight.
static flights_differ_t look(double *statistic) {
  gap_track_t t;
  candidates_t c;
  lines_t left;
  scan_t scan;
  flights_differ_t d = {.n = 0};
  why_t why = {""};
  const chosen_t none = {.n = 0};
  if (!CHECK_OK(gap_track_make(&t, &(gap_track_job_t){.spoil = start_anew}, &why))) return d;
  CHECK_OK(candidates_make(&c, &t.vehicle, &t.set, &why));
  CHECK_OK(residual_lines(&t.set, &t.vehicle, &left, &why));
  CHECK_OK(unknown_scan(&t.set, &t.vehicle, left.r, &scan, &why));
  const cell_t *const cell = &scan.cell[unknown_cell(CH_FX, LOOK_FLIGHTS, false)];
  *statistic = cell->statistic;
  scan_t nominal = {.cell = {{.statistic = 0.0}}};
  cell_t own[CHANNELS];
  const double misfit[CHANNELS] = {0.0};
  CHECK_OK(unknown_differ(&t.set, &t.vehicle, left.r, &nominal, 1, misfit, own, &why));
  CHECK(own[CH_FX].statistic == (cell->statistic > ALONE ? cell->statistic : 0.0));
  for (int k = 0; k < UNKNOWN_CELLS; k++) nominal.cell[k].statistic = cell->statistic;
  CHECK_OK(unknown_differ(&t.set, &t.vehicle, left.r, &nominal, 1, misfit, own, &why));
  CHECK(own[CH_FX].statistic == 0.0); // a nominal flight shows as much
  CHECK(cell->along == BY_FLIGHT && cell->channel == CH_FX);
  CHECK_OK(flights_differ_make(&d, &t.set, left.r, &t.vehicle, &c, &none, cell, &why));
  lines_free(&left);
  candidates_free(&c);
  gap_track_free(&t);
  return d;
}

TEST(gap_says_what_flights_differ_by) {
  static const struct {
    double more_mps2[2];
    bool differ;
  } row[] = {{{0.3, -0.2}, true}, {{0.3, 0.3}, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    double statistic;
    int which;
    ROW("%g and %g m/s2", row[i].more_mps2[0], row[i].more_mps2[1]);
    memcpy(more_mps2, row[i].more_mps2, sizeof more_mps2);
    flights_differ_t d = look(&statistic);
    CHECK((statistic > 20.0) == row[i].differ);
    if (row[i].differ && CHECK(d.n == 2)) {
      CHECK_NEAR(d.mean[0] + d.mean[1], 0.0, 1e-9);
      CHECK_NEAR(d.mean[0] - d.mean[1], 0.5, 5.0 * hypot(d.error[0], d.error[1]));
      CHECK(would(&d, "accel_bias", &which) && !would(&d, "rotor_drag", &(int){0}));
      CHECK(d.as.would[which].share > 0.9 && d.as.would[which].share <= 1.0);
      for (int f = 0; f < 2; f++) CHECK_NEAR(fx_use_size(&d.use[which * 2 + f], 0), more_mps2[f], 0.03);
    }
    flights_differ_free(&d);
  }
}

TEST(gap_tells_what_flights_differ_by_flight_by_flight) {
  double mean[8] = {-0.06, 0.13, -0.07}, error[8] = {0.003, 0.003, 0.003};
  gap_flight_t flight[8] = {{.name = "logs/a.csv"}, {.name = "b.csv"}, {.name = "again/b.csv"}};
  fx_use_t use[ACTS_AS_MAX * 8];
  char text[REPORT_DIFFER], cell[REPORT_CELL];
  study_t *const study = calloc(1, sizeof *study);
  report_t *const r = calloc(1, sizeof *r);
  r->study = study;
  study->flight = flight;
  study->fit = (gap_flights_t){flight, 3};
  for (int i = 0; i < ACTS_AS_MAX * 8; i++) {
    use[i] = fx_use(fx_find("accel_bias"));
    fx_use_resize(&use[i], 0, 0.01 * i);
    fx_use_resize(&use[i], 1, 0.0); // it is about x alone
    fx_use_resize(&use[i], 2, 0.0);
  }
  flights_differ_t d = {.n = 3,
                        .cell = {.channel = CH_FY, .along = BY_FLIGHT, .size = 0.1, .statistic = 50.0},
                        .mean = mean,
                        .error = error,
                        .use = use};
  CHECK_TEXT(report_cell(NULL, &d.cell, cell), "0.1 +- 0.002 m/s2 rms in force_y, from flight to flight");
  CHECK_TEXT(report_differ(r, &d, text), "force_y is another in each flight, about the mean of all: -0.06 in "
                                         "a.csv, +0.13 in b.csv, -0.07 in again/b.csv, +- 0.003 m/s2");
  d.as = (acts_as_t){1, {{.use = use[0], .share = 0.97}}};
  CHECK(strstr(
      report_differ(r, &d, text),
      "+- 0.003 m/s2; beyond the file and what is named it acts as accel_bias would, of another size in each "
      "(x 0, 0.01, 0.02 m/s2: 97 % of the difference)"));
  d.n = 8; // more than a line holds
  error[7] = 0.0;
  study->fit.n = 8;
  for (int f = 3; f < 8; f++) flight[f] = (gap_flight_t){.name = "d.csv"};
  CHECK(strstr(report_differ(r, &d, text), "in again/b.csv, .. +- 0.003"));
  CHECK(strstr(text, "(x 0, 0.01, 0.02, 0.03, 0.04, 0.05, .. m/s2: 97 % of the difference)"));
  free(study);
  free(r);
}

TEST(gap_finds_the_lift_over_its_mean_of_several_flights) {
  gap_track_t t;
  lines_t l;
  why_t why = {""};
  double mean = 0.0, off = 0.0, mean_mps2 = 0.0;
  if (!CHECK_OK(gap_track_make(&t, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  CHECK_OK(lines_make(&l, &t.set, &why));
  const int n = t.set.smooth.n;
  CHECK_OK(lift_find(&t.set, &t.vehicle, &why));
  CHECK_OK(residual_measured(&t.set, l.r, &why));
  for (int i = 0; i < n; i++) mean += t.set.smooth.lift[i] / n, mean_mps2 += l.r[CH_FZ][i] / n;
  for (int i = 0; i < n; i++) off += pow(t.set.smooth.lift[i] - l.r[CH_FZ][i] / mean_mps2, 2.0) / n;
  CHECK_NEAR(mean, 1.0, 1e-9);
  CHECK(sqrt(off) < 0.02); // the accelerometer's noise, and drag
  lines_free(&l);
  gap_track_free(&t);
}

// A centre of mass that is elsewhere in each flight, about x.
static void spoil_by_fitting_anew(gap_track_t *r) {
  for (int f = 0; f < 2; f++)
    for (int k = 0; k < ROTORS; k++)
      for (int i = 0; i < r->flight[f].n; i++)
        r->flight[f].v[SIG_M1 + k][i] *=
            1.0 + (f ? 0.05 : -0.05) * copysign(1.0, r->vehicle.frame.rotor_y_m[k]);
}

// They differ by 31 rad/s2 either way; what each gives more or less of its commands is a tenth of that.
TEST(gap_nominal_flights_do_not_shake_by_what_the_log_s_flights_differ_by) {
  gap_track_t r;
  why_t why = {""};
  closed_loop_t loop;
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = spoil_by_fitting_anew}, &why))) return;
  if (CHECK_OK(loop_fit(&loop, &r.set, &r.vehicle, NULL, 9, &why))) CHECK(loop.turn_radps2[0] < 6.0);
  gap_track_free(&r);
}

// Of two numbers Student's t of one degree of freedom: its upper half-hundredth, 63.66, times the root of
// 3/2.
TEST(gap_knows_how_far_another_flight_may_be_off) {
  static const struct {
    int flights;
    double may;
  } row[] = {{2, 77.96}, {3, 11.46}, {4, 6.53}, {100, 2.64}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d flights", row[i].flights);
    CHECK_NEAR(limits_another(row[i].flights), row[i].may, 0.01);
  }
}

// Another weight in each flight, 6 % apart.
static void spoil_by_weight(gap_track_t *r) {
  for (int f = 0; f < 2; f++)
    for (int k = 0; k < ROTORS; k++)
      for (int i = 0; i < r->flight[f].n; i++) r->flight[f].v[SIG_M1 + k][i] *= f ? 1.03 : 0.97;
}

// What the rows of nominal flights hold of a thrust scale, 1.
static double held_of_a_scale(void (*spoil)(gap_track_t *)) {
  gap_track_t r;
  candidates_t c;
  nominal_t n;
  why_t why = {""};
  double holds = 0.0;
  const chosen_t none = {.n = 0};
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = spoil}, &why))) return (double)NAN;
  CHECK_OK(candidates_make(&c, &r.vehicle, &r.set, &why));
  const nominal_job_t job = {&r.set, &r.vehicle, r.vehicle, &c, &none, &r.loop, 1, NULL};
  if (CHECK_OK(nominal_make(&n, &job, &why))) {
    int scale = 0;
    while (c.candidate[scale].use.fx != fx_find("thrust_scale")) scale++;
    const int k = c.candidate[scale].first;
    for (int i = 0; i < n.n; i++) holds += n.total[(i * n.size + k) * n.size + k] / n.n;
    nominal_free(&n);
  }
  candidates_free(&c);
  gap_track_free(&r);
  return holds;
}

// With the lift as sure as if no flight differed they would not show what the turning makes of a thrust
// scale, which is all that the log says of one.
TEST(gap_weighs_nominal_flights_as_the_log_s_which_differ) {
  const double alike = held_of_a_scale(NULL), differ = held_of_a_scale(spoil_by_weight);
  ROW("%g and %g", alike, differ);
  CHECK(differ > 0.0 && differ < 0.3 * alike); // 0.13; as much as alike where the lift is as sure
}
