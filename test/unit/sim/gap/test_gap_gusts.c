// test_gap_gusts.c - noise of the moment and forces that last are told apart, and how long they last; what
// sets in once is neither.
#include "gap/3_feedback/gusts.h"
#include "base/random.h"
#include "rig/gap_track.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>

// What is put upon the accelerations of a row's flights.
static double gust_mps2, gust_tau_s, step_mps2;
static int first_axis; // the axes from this one on have them

static void put(gap_track_t *t) {
  random_t *const random = random_open(5);
  for (int f = 0; f < 2; f++) {
    const gap_flight_t *const to = &t->flight[f];
    const double keep = exp(-(to->t_s[1] - to->t_s[0]) / fmax(gust_tau_s, 1e-3));
    double gust[3] = {0.0};
    for (int i = 0; i < to->n; i++)
      for (int k = 0; k < 3; k++) {
        gust[k] = keep * gust[k] + sqrt(1.0 - keep * keep) * gust_mps2 * random_normal(random);
        const double step = i > 0.71 * to->n ? step_mps2 : 0.0;
        to->v[SIG_AX + k][i] += (k >= first_axis ? gust[k] : 0.0) + step;
      }
  }
  random_close(random);
}

static gusts_t read_gusts(void) {
  gap_track_t t;
  lines_t l = {.r = {NULL}};
  gusts_t gusts = {.tau_s = 0.0};
  why_t why = {""};
  if (!CHECK_OK(gap_track_make(&t, &(gap_track_job_t){.spoil = put}, &why))) return gusts;
  CHECK_OK(residual_lines(&t.set, &t.vehicle, &l, &why));
  CHECK_OK(gusts_of(&t.set, l.r, t.loop.acc_mps2, 3, &gusts, &why));
  lines_free(&l);
  gap_track_free(&t);
  return gusts;
}

// The exam's accelerometer has 0.5 m/s2. Two flights of 40 s hold hardly a hundred gusts of 0.8 s, of which
// the quieter half of the stretches counts.
TEST(gap_reads_how_strong_gusts_are_and_how_long_they_last) {
  static const struct {
    const char *what;
    double gust_mps2, tau_s, step_mps2;
    int first_axis;
    double least_s, most_s;       // of the correlation time
    double least_mps2, most_mps2; // of what is read
  } row[] = {{"noise alone", 0.0, 0.0, 0.0, 0, 0.0, 2.0, 0.0, 0.08},
             {"quick gusts", 0.2, 0.1, 0.0, 0, 0.05, 0.2, 0.15, 0.25},
             {"gusts", 0.2, 0.8, 0.0, 0, 0.4, 2.0, 0.15, 0.25},
             {"a force along z that comes and goes", 0.2, 0.8, 0.0, 2, 0.0, 2.0, 0.0, 0.08},
             {"a force that sets in", 0.0, 0.0, 1.0, 0, 0.0, 2.0, 0.0, 0.08}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gust_mps2 = row[i].gust_mps2;
    gust_tau_s = row[i].tau_s;
    step_mps2 = row[i].step_mps2;
    first_axis = row[i].first_axis;
    const gusts_t gusts = read_gusts();
    CHECK(gusts.tau_s >= row[i].least_s && gusts.tau_s <= row[i].most_s);
    for (int k = 0; k < 3; k++) {
      CHECK(gusts.force_mps2[k] >= row[i].least_mps2 && gusts.force_mps2[k] <= row[i].most_mps2);
      if (row[i].first_axis == 0) CHECK(gusts.quick_mps2[k] <= 0.12);
    }
  }
}
