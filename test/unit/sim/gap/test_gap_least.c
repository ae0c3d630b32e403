// test_gap_least.c - the size from which on an effect would have been seen, in rows that no flight made.
#include "gap/5_infer/evidence.h"
#include "gap/5_infer/found.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <math.h>

// Over what is typical, of a column that has so many standard errors there. Beside two of these: the Wald
// test's bound, 3.9 of them for one of three candidates in 23 blocks; the gain, 0.004 of what 7200 rows
// leave; what another one that gives all but 2e-4 of it could not, the root of 36 over these; and the least
// that is named. Of the torque, which other pilots make as large again, the rows speak from 6.4 times on what
// nominal flights make of it, and the gate asks for 3.2 times.
TEST(gap_tells_the_least_size_that_would_have_been_seen) {
  static const struct {
    const char *what, *effect;
    double sure, made; // made: of nominal flights, rms
    bool alike;
    double least;
  } row[] = {{"by the gain", "rotor_drag", 20.0, 0.0, false, 0.268 + 2.0 / 20.0},
             {"by the least that is named", "rotor_drag", 2000.0, 0.0, false, 0.12 + 2.0 / 2000.0},
             {"by a rival", "rotor_drag", 1000.0, 0.0, true, 0.424 + 2.0 / 1000.0},
             {"by what the rows speak for", "torque_ratio", 2000.0, 0.1, false, 0.64 + 2.0 * 0.1}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    found_t found;
    why_t why;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 13);
    const int of = gap_rows_along(&g, row[i].effect, CH_FX, row[i].sure);
    const int other = gap_rows_along(&g, "flapping", CH_FX, row[i].sure);
    double *const x = gap_rows_column(&g, of, 0, CH_FX), *const y = gap_rows_column(&g, other, 0, CH_FX);
    for (int k = 0; k < GAP_ROWS && row[i].alike; k++) y[k] = x[k] + 0.0141 * y[k];
    double made[2 * NOMINAL_FLIGHTS] = {0.0};
    for (int f = 0; f < NOMINAL_FLIGHTS; f++) made[2 * f] = f % 2 ? -row[i].made : row[i].made;
    if (row[i].made > 0.0) gap_rows_nominal(&g, NOMINAL_FLIGHTS, 4e6, made);
    gap_rows_open(&g, 0, NULL);
    CHECK_OK(found_make(&found, &g.candidates, &why));
    CHECK_OK(found_describe(&found, &g.round, &(const timing_t){.candidate = -1}, &why));
    CHECK_NEAR(found.least[of], row[i].least, 0.12 * row[i].least);
    found_free(&found);
    gap_rows_free(&g);
  }
}

// A number of either sign, of which the rows hold 400: from four standard errors on.
TEST(gap_tells_from_which_size_on_the_rows_speak_for_an_effect) {
  static const struct {
    const char *what;
    double times;
    bool chosen, there; // chosen: it is named already
  } row[] = {{"four fifths of it", 0.8, false, false},
             {"a quarter more", 1.25, false, true},
             {"a quarter more of what is named", 1.25, true, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    double least[GAP_COLUMNS], odds[NAMED_MAX];
    why_t why;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 26);
    const int of = gap_rows_along(&g, "mass", CH_FX, 20.0),
              beside = gap_rows_along(&g, "flapping", CH_FY, 20.0);
    gap_rows_nominal(&g, 0, 0.0, NULL);
    gap_rows_open(&g, 1, row[i].chosen ? &of : &beside);
    if (!CHECK_OK(evidence_least(&g.round, least, &why))) return;
    const int column = g.candidate[of].first;
    CHECK_NEAR(least[column], 0.2, 0.05);
    gap_rows_add(&g, of, 0, row[i].times * least[column]);
    gap_rows_open(&g, 1, &of);
    CHECK_OK(evidence_odds(&g.round, odds, &why));
    CHECK((odds[0] > 0.0) == row[i].there);
    gap_rows_free(&g);
  }
}
