// test_gap_rows.c - series of a flight as rows, through the zero-phase low-pass.
#include "base/random.h"
#include "gap/2_predict/residual.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>

#define POINTS   6000 // two minutes at 50 Hz
#define PERIOD_S 0.02
#define SOME     100

static set_t set_of(int flights, int points) {
  set_t s;
  why_t why;
  grid_t *const grid = calloc((size_t)flights, sizeof *grid);
  if (!grid) abort();
  for (int f = 0; f < flights; f++) {
    grid[f] =
        (grid_t){.period_s = PERIOD_S, .n = points, .point = calloc((size_t)points, sizeof(grid_point_t))};
    if (!grid[f].point) abort();
    for (int j = 0; j < points; j++)
      grid[f].point[j] = (grid_point_t){.t_s = PERIOD_S * j, .ok = true, .range_m = 0.5};
  }
  CHECK_OK(set_make(&s, grid, flights, &why));
  return s;
}

// Every wanted channel gets the same series.
static void rows_of(const set_t *s, int flight, const double *series, double *const row[CHANNELS]) {
  const double *every[CHANNELS];
  double *const scratch = calloc(RESIDUAL_SCRATCH * POINTS, sizeof(double));
  if (!scratch) abort();
  for (int ch = 0; ch < CHANNELS; ch++) every[ch] = series;
  residual_rows(s, flight, SERIES_PREDICTED, every, scratch, row);
  free(scratch);
}

// What dies away in a filter becomes numbers with which processors are tens of times as slow: the longer the
// log, the more of them.
TEST(gap_rows_hold_no_number_that_is_almost_nothing) {
  set_t s = set_of(1, POINTS);
  double *const series = calloc(POINTS, sizeof(double)), *const row = calloc(POINTS, sizeof(double));
  if (!series || !row) abort();
  for (int j = 0; j < SOME; j++) series[j] = 1.0;
  rows_of(&s, 0, series, (double *[CHANNELS]){[CH_FY] = row});
  CHECK_NEAR(row[10], 1.0, 1e-9);
  int tiny = 0, small = 0;
  for (int i = 0; i < s.smooth.n; i++) {
    tiny += row[i] != 0.0 && fabs(row[i]) < 1e-140;
    small += row[i] != 0.0 && fabs(row[i]) < 1e-60;
  }
  CHECK(tiny == 0);
  CHECK(small > 0); // the tail as such is there
  CHECK_NEAR(row[s.smooth.n - 1], 0.0, 0.0);
  free(series);
  free(row);
  set_free(&s);
}

TEST(gap_rows_of_a_flight_are_its_own_and_only_those_that_are_wanted) {
  set_t s = set_of(3, POINTS);
  double *const series = calloc(POINTS, sizeof(double)), *const y = calloc(3 * POINTS, sizeof(double)),
                *const range = calloc(3 * POINTS, sizeof(double));
  if (!series || !y || !range) abort();
  for (int j = 0; j < POINTS; j++) series[j] = 2.0;
  CHECK(rows_from(&s.smooth, 0) == 0 && rows_from(&s.smooth, 3) == s.smooth.n);
  CHECK(rows_from(&s.smooth, 1) == s.smooth.n / 3);
  rows_of(&s, 1, series, (double *[CHANNELS]){[CH_WY] = y, [CH_RANGE] = range});
  for (int i = 0; i < s.smooth.n; i++) CHECK_NEAR(y[i], s.smooth.flight[i] == 1 ? 2.0 : 0.0, 1e-9);
  for (int i = 0; i < s.range.n; i++) CHECK_NEAR(range[i], s.range.flight[i] == 1 ? 2.0 : 0.0, 0.0);
  free(series);
  free(y);
  free(range);
  set_free(&s);
}

// What is met in one flight alone has to be confirmed by the same flight; slow drifts are not to be.
TEST(gap_halves_of_a_flight_interleave) {
  static const struct {
    int flights;
    double span_s, at_s; // of the first flight
    int half;
  } row[] = {{1, 12.0, 1.0, 0},  {1, 12.0, 3.0, 1},   {1, 12.0, 5.0, 0},   {1, 12.0, 11.0, 1},
             {1, 120.1, 1.0, 0}, {1, 120.1, 19.0, 0}, {1, 120.1, 21.0, 1}, {1, 120.1, 41.0, 0},
             {2, 12.0, 1.0, 0},  {2, 12.0, 3.0, 1},   {2, 12.0, 5.0, 0},   {2, 12.0, 11.0, 1}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d of %g s, at %g s", row[i].flights, row[i].span_s, row[i].at_s);
    set_t s = set_of(row[i].flights, (int)lround(row[i].span_s / PERIOD_S));
    int k = 0;
    while (s.grid[0].point[s.smooth.point[k]].t_s < row[i].at_s) k++;
    CHECK(s.half[s.smooth.block[k]] == row[i].half && s.n_half == 2 * row[i].flights);
    set_free(&s);
  }
}

// 2000 rows of white noise. A step of 50 of its sd, over four rows, has 625 squares of the increments, noise
// has 4000. Of a hundred such steps the largest hundredth of the rows is no more than its share.
TEST(gap_jumps_are_few) {
  static const struct {
    int jumps;
    double least, most;
  } row[] = {{0, 0.0, 0.02}, {1, 0.1, 0.15}, {4, 0.3, 0.4}, {100, 0.0, 0.02}};
  enum { ROWS = 2000, TOO_FEW = 100 };
  static bool follows[ROWS];
  static double v[ROWS];
  const rows_t rows = {.n = ROWS, .follows = follows}, few = {.n = TOO_FEW, .follows = follows};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d", row[i].jumps);
    random_t *const random = random_open(5);
    double at = 0.0;
    for (int k = 0; k < ROWS; k++) {
      const int every = row[i].jumps ? ROWS / row[i].jumps : ROWS, into = k % every;
      if (row[i].jumps && into >= 8 && into < 12) at += k / every % 2 ? -12.5 : 12.5;
      follows[k] = k > 0;
      v[k] = at + random_normal(random);
    }
    random_close(random);
    const double jumps = residual_jumps(&rows, v);
    CHECK(jumps >= row[i].least && jumps <= row[i].most);
    CHECK(residual_jumps(&few, v) == 0.0); // 99 increments
  }
}
