// test_gap_timing.c - a lag or delay that measured rotor speeds show.
#include "gap/5_infer/timing.h"
#include "base/random.h"
#include "rig/gap_track.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
  const char *what;
  double more_s, noise; // of the motors' lag, beside the file's; of a speed
  int every;            // of the samples of 500 Hz
  uint64_t seed;
  double told_s; // below 0: nothing
  bool means;    // rows are means
} speeds_t;

static speeds_t row_of; // the job of a spoiler that has no argument

// What is left of so many rows is their mean.
static void average(gap_flight_t *f, int every) {
  f->rows_are_means = true;
  for (int s = 0; s < SIG_COUNT; s++)
    for (int i = 0; f->v[s] && i + every <= f->n; i += every)
      for (int k = 1; k < every; k++) f->v[s][i] += (f->v[s][i + k] - f->v[s][i]) / (k + 1);
}

// Speeds follow the commands by a first-order lag, and are measured with noise.
static void measure(gap_track_t *t) {
  random_t *const r = random_open(row_of.seed);
  if (!r) abort();
  const double tau_s = t->vehicle.motor_tau_s + row_of.more_s;
  for (int f = 0; f < 2; f++) {
    gap_flight_t *const to = &t->flight[f];
    const int late = (int)lround(t->vehicle.frame.motor_delay_s * to->rate_Hz);
    for (int k = 0; k < ROTORS; k++) {
      double *const w = to->v[SIG_W1 + k] = malloc((size_t)to->n * sizeof(double));
      double turns = to->v[SIG_M1 + k][0];
      if (!w) abort();
      for (int i = 0; i < to->n; i++) {
        const double told = to->v[SIG_M1 + k][i > late ? i - late : 0];
        w[i] = sqrt(fmax(turns, 0.0) / t->vehicle.frame.kf_Ns2) * (1.0 + row_of.noise * random_normal(r));
        turns += (told - turns) * (1.0 - exp(-1.0 / to->rate_Hz / tau_s));
      }
    }
  }
  random_close(r);
  for (int f = 0; f < 2 && row_of.means; f++) average(&t->flight[f], row_of.every);
  gap_track_thin(t, row_of.every);
}

TEST(gap_tells_by_rotor_speeds_a_lag_that_is_surely_there) {
  static const speeds_t row[] = {
      {"as in the file", 0.0, 0.001, 1, 1, -1.0, false},
      {"30 ms more", 0.03, 0.001, 1, 2, 0.03, false},
      {"30 ms more, noisy speeds", 0.03, 0.01, 1, 3, 0.03, false},
      {"as in the file, four commands of five missed", 0.0, 0.004, 5, 4, -1.0, false},
      {"30 ms more, and rows are means of all commands", 0.03, 0.001, 5, 5, 0.03, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_track_t t;
    candidates_t c;
    timing_t found;
    why_t why = {""};
    ROW("%s", row[i].what);
    row_of = row[i];
    if (!CHECK_OK(gap_track_make(&t, &(gap_track_job_t){.spoil = measure}, &why))) return;
    CHECK_OK(candidates_make(&c, &t.vehicle, &t.set, &why));
    CHECK_OK(timing_find(&found, &c, &t.set, &t.vehicle, &why));
    if (CHECK((found.candidate >= 0) == (row[i].told_s >= 0.0)) && found.candidate >= 0)
      CHECK(found.measured && fabs(found.value_s - row[i].told_s) < 2.0 * found.stderr_s);
    candidates_free(&c);
    gap_track_free(&t);
  }
}
