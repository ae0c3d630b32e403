// test_gap_pairs.c - two effects that hide each other, in rows that no flight made.
#include "gap/5_infer/pairs.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <math.h>

#define SIZE 20.0 // standard errors of a typical size

// One candidate along force_x, as `common` and another noise have it.
static int along_x(gap_rows_t *g, const char *effect, const double *common, double share) {
  const int i = gap_rows_candidate(g, effect);
  double *const x = gap_rows_column(g, i, 0, CH_FX);
  gap_rows_white(g, x);
  for (int k = 0; k < GAP_ROWS; k++)
    x[k] = (share * common[k] + sqrt(1.0 - share * share) * x[k]) * SIZE / sqrt(GAP_ROWS);
  return i;
}

// share: squared, it is the correlation of the two; sizes are typical ones.
static const struct {
  const char *what, *first, *second;
  double share, size[2];
  bool out, found;
} PAIRS[] = {
    {"against each other", "rotor_drag", "mass", 0.95, {2.0, -2.0}, false, true},
    {"with each other: either is seen", "rotor_drag", "mass", 0.95, {2.0, 2.0}, false, false},
    {"one alone", "rotor_drag", "mass", 0.95, {2.0, 0.0}, false, false},
    {"not alike: both are seen", "rotor_drag", "mass", 0.0, {2.0, -2.0}, false, false},
    {"smaller than a share of what is left", "rotor_drag", "mass", 0.95, {0.2, -0.2}, false, false},
    {"the second may not come in", "rotor_drag", "mass", 0.95, {2.0, -2.0}, true, false},
    {"of which only one is told", "mass", "thrust_scale", 0.95, {2.0, -2.0}, false, false},
};

TEST(gap_finds_two_effects_that_hide_each_other) {
  for (unsigned i = 0; i < sizeof PAIRS / sizeof *PAIRS; i++) {
    ROW("%s", PAIRS[i].what);
    gap_rows_t g;
    double common[GAP_ROWS];
    pairs_t pairs;
    why_t why;
    gap_rows_make(&g, 900 + i);
    gap_rows_white(&g, common);
    const int first = along_x(&g, PAIRS[i].first, common, PAIRS[i].share);
    const int second = along_x(&g, PAIRS[i].second, common, PAIRS[i].share);
    along_x(&g, "wind", common, 0.0);
    gap_rows_add(&g, first, 0, PAIRS[i].size[0]);
    gap_rows_add(&g, second, 0, PAIRS[i].size[1]);
    gap_rows_open(&g, 0, NULL);
    bool out[GAP_COLUMNS] = {false};
    out[second] = PAIRS[i].out;
    CHECK_OK(pairs_find(&pairs, &g.round, out, &why));
    CHECK((pairs.n > 0) == PAIRS[i].found);
    if (pairs.n > 0) CHECK(pairs_sure(&g.round, &pairs.pair[0]));
    if (pairs.n > 0) CHECK(pairs.pair[0].of[0] == first && pairs.pair[0].of[1] == second);
    pairs_free(&pairs);
    gap_rows_free(&g);
  }
}
