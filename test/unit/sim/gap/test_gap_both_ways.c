// test_gap_both_ways.c - a scale of the turning, and commands that a log misses.
#include "gap/5_infer/both_ways.h"
#include "rig/test.h"

#include "base/random.h"
#include <math.h>
#include <stdlib.h>

#define ROWS 800

// Rows that are white: true turning of sd 1, of which the model predicts (1 + k) and an error, and a gyro
// measures with another.
static increments_t rows_of(double k, double missed, double noise, uint64_t seed, double *by_least_squares) {
  bool follows[ROWS];
  double measured[ROWS], left[ROWS];
  random_t *const r = random_open(seed);
  if (!r) abort();
  for (int i = 0; i < ROWS; i++) {
    const double turns = random_normal(r), predicted = (1.0 + k) * turns + missed * random_normal(r);
    follows[i] = i > 0;
    measured[i] = turns + noise * random_normal(r);
    left[i] = measured[i] - predicted;
  }
  random_close(r);
  const rows_t rows = {.n = ROWS, .follows = follows};
  const increments_t s = increments_of(&rows, measured, left);
  *by_least_squares = s.pp / s.yp - 1.0;
  return s;
}

TEST(gap_takes_for_inertia_only_what_measured_by_predicted_and_predicted_by_measured_both_say) {
  static const struct {
    const char *what;
    double k, missed, noise;
    bool agree;
  } row[] = {
      {"half as much again", 0.5, 0.0, 0.0, true},
      {"the same, a gyro's noise", 0.5, 0.0, 0.2, true},
      {"the same, some commands missed", 0.5, 0.7, 0.2, true},
      {"a third less: so does noise that is fed back", -0.33, 0.0, 0.0, false},
      {"the same, as much missed as told", 0.5, 1.5, 0.0, false}, // 0.5 to 2
      {"nothing", 0.0, 0.0, 0.0, false},
      {"nothing, a gyro's noise", 0.0, 0.0, 0.3, false},
      {"nothing, half of the commands missed", 0.0, 0.7, 0.0, false},
      {"nothing, most of them missed", 0.0, 1.4, 0.2, false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    double k;
    const increments_t s = rows_of(row[i].k, row[i].missed, row[i].noise, 1 + i, &k);
    const double agreed = both_ways_agree(&s, k, 0.05);
    CHECK((agreed != 0.0) == row[i].agree);
    if (row[i].agree) CHECK_NEAR(agreed, row[i].k, 0.1);
  }
}

TEST(gap_takes_no_inertia_within_two_standard_errors) {
  double k;
  const increments_t s = rows_of(0.5, 0.0, 0.0, 1, &k);
  CHECK(both_ways_agree(&s, k, 0.24) > 0.0);
  CHECK(both_ways_agree(&s, k, 0.26) == 0.0);
  CHECK(both_ways_agree(&s, 0.2, 0.05) == 0.0); // the rows themselves say 0.5
  CHECK(both_ways_agree(&(increments_t){0}, 0.5, 0.05) == 0.0);
}
