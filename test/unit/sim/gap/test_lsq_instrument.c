// test_lsq_instrument.c - two-stage least squares where the truth is known: a regressor that a disturbance
// feeds, and instruments that it does not.
#include "base/lsq_instrument.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <string.h>

#define BLOCKS 40
#define ROWS   50 // of a block
#define LAGS   2
#define SETS   2

typedef struct {
  double total[36], block[BLOCKS][36];
} sums_t;

static void add(sums_t *s, int block, const double *row, int size) {
  for (int i = 0; i < size; i++)
    for (int k = 0; k < size; k++) {
      s->block[block][i * size + k] += row[i] * row[k];
      s->total[i * size + k] += row[i] * row[k];
    }
}

// y = 2 x + e, x = strength (z1 + z2) + feedback e + noise; a second set of instruments has nothing to do
// with any of it.
static void make(sums_t *s, double strength, double feedback, uint64_t seed) {
  splitmix_t r = {seed};
  memset(s, 0, sizeof *s);
  for (int i = 0; i < BLOCKS * ROWS; i++) {
    const double z1 = splitmix_normal(&r, 1.0), z2 = splitmix_normal(&r, 1.0), e = splitmix_normal(&r, 1.0);
    const double x = strength * (z1 + z2) + feedback * e + splitmix_normal(&r, 1.0);
    const double row[] = {x, z1, z2, splitmix_normal(&r, 1.0), splitmix_normal(&r, 1.0), 2.0 * x + e};
    add(s, i / ROWS, row, 6);
  }
}

typedef struct {
  double plain, b, F, blocks, V, apart;
} got_t;

static got_t solve(const sums_t *s) {
  got_t g = {0};
  const lsq_instrument_t job = {s->total, s->block[0], BLOCKS, 1, SETS, LAGS, 10.0, NULL, NULL};
  CHECK(lsq_instrument(&job, &(lsq_instrumented_t){&g.plain, &g.b, &g.F, &g.blocks, &g.V, &g.apart}));
  return g;
}

TEST(lsq_instrument_finds_what_feedback_hides_from_least_squares) {
  static sums_t s;
  make(&s, 0.5, 0.8, 3);
  const got_t g = solve(&s);
  CHECK(g.plain > 2.2); // cov(x, e)/var(x) = 0.8/2.14 too much
  CHECK_NEAR(g.b, 2.0, 3.0 * sqrt(g.V));
  CHECK_NEAR(sqrt(g.V), 1.0 / sqrt(0.5 * BLOCKS * ROWS), 0.01); // sd(e)/|xhat|
  CHECK(g.F > 100.0);
  CHECK(g.blocks > 0.8 * BLOCKS && g.blocks <= BLOCKS);
  CHECK(fabs(g.b - g.plain) > 5.0 * sqrt(g.apart));
}

TEST(lsq_instrument_agrees_with_least_squares_where_nothing_feeds_back) {
  for (uint64_t seed = 1; seed <= 20; seed++) {
    static sums_t s;
    ROW("seed %d", (int)seed);
    make(&s, 0.5, 0.0, seed);
    const got_t g = solve(&s);
    CHECK_NEAR(g.b, 2.0, 3.5 * sqrt(g.V));
    CHECK_NEAR(g.b, g.plain, 3.5 * sqrt(g.apart));
  }
}

// Of 200 draws, errors squared over the variances that were told: 1 but for the jackknife's own bias. In
// units a thousand times as small all numbers are so many times as large.
TEST(lsq_instrument_tells_how_far_its_numbers_spread_in_any_unit) {
  static sums_t s, small;
  double of_b = 0.0, of_apart = 0.0;
  for (uint64_t seed = 1; seed <= 200; seed++) {
    make(&s, 0.5, 0.0, 1000 + seed);
    const got_t g = solve(&s);
    of_b += (g.b - 2.0) * (g.b - 2.0) / g.V / 200.0;
    of_apart += (g.b - g.plain) * (g.b - g.plain) / g.apart / 200.0;
  }
  CHECK(of_b > 0.75 && of_b < 1.3); // chi-squared of 200: 0.8 to 1.2
  CHECK(of_apart > 0.75 && of_apart < 1.3);
  const got_t g = solve(&s);
  small = s;
  for (int i = 0; i < (1 + BLOCKS) * 36; i++) {
    double *const v = i < 36 ? &small.total[i] : &small.block[i / 36 - 1][i % 36];
    *v *= (i / 6 % 6 < 5 ? 1e-3 : 1.0) * (i % 6 < 5 ? 1e-3 : 1.0); // all but y
  }
  const got_t in_small = solve(&small);
  CHECK_NEAR(in_small.b / g.b, 1e3, 1e-6);
  CHECK_NEAR(in_small.V / g.V, 1e6, 1e-3);
  CHECK_NEAR(in_small.apart / g.apart, 1e6, 1e-3);
  CHECK_NEAR(in_small.F / g.F, 1.0, 1e-9);
}

// Measured with errors x is found too small by plain least squares; measured without, as the instrument has
// it.
TEST(lsq_instrument_is_held_against_least_squares_of_a_better_measurement) {
  static sums_t s;
  static double better[4], of_block[BLOCKS][4]; // x without errors, y
  splitmix_t r = {8};
  for (int i = 0; i < BLOCKS * ROWS; i++) {
    const double z1 = splitmix_normal(&r, 1.0), z2 = splitmix_normal(&r, 1.0), x = z1 + z2;
    const double y = 2.0 * x + splitmix_normal(&r, 1.0), off = splitmix_normal(&r, 1.0), xy[] = {x, y};
    const double row[] = {x + off, z1, z2, splitmix_normal(&r, 1.0), splitmix_normal(&r, 1.0), y};
    add(&s, i / ROWS, row, 6);
    for (int k = 0; k < 4; k++) {
      better[k] += xy[k / 2] * xy[k % 2];
      of_block[i / ROWS][k] += xy[k / 2] * xy[k % 2];
    }
  }
  for (int held = 0; held < 2; held++) {
    ROW("%s", held ? "without errors" : "with errors");
    got_t g = {0};
    lsq_instrument_t job = {s.total, s.block[0], BLOCKS, 1, SETS, LAGS, 10.0, NULL, NULL};
    if (held) job.plain_total = better, job.plain_block = of_block[0];
    CHECK(lsq_instrument(&job, &(lsq_instrumented_t){&g.plain, &g.b, &g.F, &g.blocks, &g.V, &g.apart}));
    CHECK_NEAR(g.b, 2.0, 3.0 * sqrt(g.V));
    CHECK_NEAR(g.plain, held ? 2.0 : 4.0 / 3.0, 0.1); // var(x)/(var(x) + var(off)) of it
    CHECK(held == (fabs(g.b - g.plain) < 3.0 * sqrt(g.apart)));
  }
}

TEST(lsq_instrument_tells_when_it_is_too_weak) {
  for (uint64_t seed = 1; seed <= 20; seed++) {
    static sums_t s;
    ROW("seed %d", (int)seed);
    make(&s, 0.0, 0.8, seed);
    const got_t g = solve(&s);
    CHECK(g.F < 10.0);
    CHECK_NEAR(g.b, g.plain, 1e-9); // it stands for itself
  }
}

TEST(lsq_instrument_has_no_solution_without_a_regressor_that_moves) {
  static sums_t s;
  got_t g;
  memset(&s, 0, sizeof s);
  const lsq_instrument_t job = {s.total, s.block[0], BLOCKS, 1, SETS, LAGS, 10.0, NULL, NULL};
  CHECK(!lsq_instrument(&job, &(lsq_instrumented_t){&g.plain, &g.b, &g.F, &g.blocks, &g.V, &g.apart}));
}
