// test_gap_score.c - how well a choice explains rows that no flight made, and what may enter it.
#include "base/lsq_blocks.h"
#include "gap/5_infer/beyond_control.h"
#include "gap/5_infer/found.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const choice_t NONE = {.n = 0};

// One candidate along force_x, so strong that a typical one has `sure` standard errors.
static int along_x(gap_rows_t *g, const char *effect, double sure) {
  const int i = gap_rows_candidate(g, effect);
  double *const x = gap_rows_column(g, i, 0, CH_FX);
  gap_rows_white(g, x);
  for (int k = 0; k < GAP_ROWS; k++) x[k] *= sure / sqrt(GAP_ROWS);
  return i;
}

TEST(gap_score_estimates_with_the_error_that_it_tells) {
  double off = 0.0, told = 0.0;
  const int draws = 60;
  for (int d = 0; d < draws; d++) {
    gap_rows_t g;
    gap_rows_make(&g, 100 + (unsigned long)d);
    const int drag = along_x(&g, "rotor_drag", 20.0);
    gap_rows_add(&g, drag, 0, 1.5);
    gap_rows_open(&g, 0, NULL);
    const choice_t with = choice_with(&NONE, drag);
    const verdict_t v = score_last(&g.round.score, &with);
    const double typical = g.candidate[drag].typical[0];
    off += pow(v.value[0] / typical - 1.5, 2) / draws;
    told += v.stderr_[0] * v.stderr_[0] / typical / typical / draws;
    CHECK(v.p < 1e-6);
    CHECK(score_left(&g.round.score, &with, NULL) < score_left(&g.round.score, &NONE, NULL));
    gap_rows_free(&g);
  }
  CHECK_NEAR(sqrt(told), 1.0 / 20.0, 0.01);
  CHECK_NEAR(sqrt(off / told), 1.0, 0.25); // of 60 draws
}

// A disturbance, beside which the effect is surely seen and explains less than one in twenty.
#define REST 10.0
static const struct {
  const char *what, *effect;
  // Over what is typical; nominal: rms, 0: no nominal flights, below 0: none could fly; has: the vehicle
  // file; rest: sd of what is left besides, in the effect's channel.
  double size, nominal, has, rest;
  bool enters;
} LET_IN[] = {
    {"a first look", "rotor_drag", 0.5, 0.0, 0.0, 0.0, true},
    {"smaller than is named", "rotor_drag", 0.1, 0.0, 0.0, 0.0, false},
    {"of the wrong sign", "rotor_drag", -0.5, 0.0, 0.0, 0.0, false},
    {"either sign", "mass", -0.5, 0.0, 0.0, 0.0, true},
    {"four times what feedback makes", "rotor_drag", 0.5, 0.125, 0.0, 0.0, true},
    {"twice what feedback makes", "rotor_drag", 0.5, 0.25, 0.0, 0.0, false},
    {"none could fly", "rotor_drag", 0.45, -1.0, 0.0, 0.0, true},
    {"none could fly, and it is smaller", "rotor_drag", 0.28, -1.0, 0.0, 0.0, false},
    {"only beside nominal flights", "inertia", 0.5, 0.0, 0.0, REST, false},
    {"of the sign that no control makes", "inertia", -0.5, 0.0, 0.0, REST, true},
    {"which for torque is above 0", "torque_ratio", 0.5, 0.0, 0.0, REST, true},
    {"and not below", "torque_ratio", -0.5, 0.0, 0.0, REST, false},
    {"but where it explains more than control could", "inertia", 0.5, 0.0, 0.0, 0.0, true},
    {"by a fifth", "inertia", 0.5, 0.0, 0.0, 1.45, true},
    {"and not as much but for a quarter", "inertia", 0.5, 0.0, 0.0, 3.2, false},
    {"more of a torque", "torque_ratio", -0.5, 0.0, 0.0, 0.0, true},
    {"and there", "inertia", 0.5, 0.05, 0.0, 0.0, true},
    {"and none could fly", "inertia", 0.9, -1.0, 0.0, 0.0, false},
    // With this noise two errors (0.005 each) less are seen than is hidden.
    {"what the file has, seen as none", "rotor_drag", -0.99, 0.0, 1.0, 0.0, true},
    {"seen as less than none by an error", "rotor_drag", -0.997, 0.0, 1.0, 0.0, true},
    {"seen as less than none by six", "rotor_drag", -1.02, 0.0, 1.0, 0.0, false},
};

TEST(gap_score_lets_in_what_is_large_of_the_right_sign_and_no_work_of_feedback) {
  for (unsigned i = 0; i < sizeof LET_IN / sizeof *LET_IN; i++) {
    gap_rows_t g;
    ROW("%s", LET_IN[i].what);
    gap_rows_make(&g, 7);
    const int of = along_x(&g, LET_IN[i].effect, 200.0);
    g.candidate[of].least[0] -= LET_IN[i].has * g.candidate[of].typical[0];
    g.candidate[of].in_file = LET_IN[i].has > 0.0;
    for (int k = 1; k < g.candidate[of].n; k++) gap_rows_white(&g, gap_rows_column(&g, of, k, CH_FY + k - 1));
    gap_rows_add(&g, of, 0, LET_IN[i].size);
    double *const rest = calloc(GAP_ROWS, sizeof(double));
    gap_rows_white(&g, rest);
    for (int k = 0; k < GAP_ROWS; k++) g.residual[CH_FX][k] += LET_IN[i].rest * rest[k];
    free(rest);
    const double rms = LET_IN[i].nominal;
    const int flights = rms > 0.0 ? NOMINAL_FLIGHTS : 0;
    double found[NOMINAL_FLIGHTS * FX_SIZE_MAX];
    for (int k = 0; k < NOMINAL_FLIGHTS * FX_SIZE_MAX; k++) found[k] = k / g.candidate[of].n % 2 ? -rms : rms;
    if (rms != 0.0) gap_rows_nominal(&g, flights, 1e6, found);
    gap_rows_open(&g, 0, NULL);
    const choice_t with = choice_with(&NONE, of);
    const verdict_t v = score_last(&g.round.score, &with);
    const bool lets_in =
        beyond_control(&g.round, &with, &v, false) && score_allows(&g.round.score, &with, &v);
    CHECK(lets_in == LET_IN[i].enters);
    gap_rows_free(&g);
  }
}

// These nominal flights make 0.5 of it, all others a fiftieth: only those count that would show 0.5.
TEST(gap_score_asks_flights_that_would_show_a_size_what_feedback_makes_of_it) {
  static const struct {
    const char *what;
    int flights;
    double holds; // standard errors of a typical size
    bool enters;
  } row[] = {{"one that shows it well", 1, 200.0, false},
             {"one that would show it", 1, 5.0, false},
             {"one that would not", 1, 3.0, true},
             {"five that would not", 5, 3.0, true},
             {"six that would not: all count", 6, 3.0, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    double made[NOMINAL_FLIGHTS];
    ROW("%s", row[i].what);
    gap_rows_make(&g, 7);
    const int of = along_x(&g, "rotor_drag", 200.0);
    gap_rows_add(&g, of, 0, 0.5);
    for (int k = 0; k < NOMINAL_FLIGHTS; k++) made[k] = k < row[i].flights ? 0.5 : 0.01;
    gap_rows_nominal(&g, NOMINAL_FLIGHTS, 4e4, made);
    for (int k = 0; k < 4 * row[i].flights; k++) g.nominal.total[k] *= row[i].holds * row[i].holds / 4e4;
    gap_rows_open(&g, 0, NULL);
    const choice_t with = choice_with(&NONE, of);
    const verdict_t v = score_last(&g.round.score, &with);
    CHECK(score_allows(&g.round.score, &with, &v) == row[i].enters);
    gap_rows_free(&g);
  }
}

// J (1 + k) turns by k / (1 + k) less: of columns about nothing that is the number, about k it is not.
TEST(gap_score_takes_the_slope_of_an_inertia_for_what_control_could_make) {
  gap_rows_t g;
  gap_rows_make(&g, 7);
  const int of = along_x(&g, "inertia", 200.0);
  for (int k = 1; k < g.candidate[of].n; k++) gap_rows_white(&g, gap_rows_column(&g, of, k, CH_FY + k - 1));
  gap_rows_add(&g, of, 0, 6.0);
  gap_rows_open(&g, 0, NULL);
  const choice_t with = choice_with(&NONE, of);
  const double share =
      1.0 - score_left(&g.round.score, &with, NULL) / score_left(&g.round.score, &NONE, NULL);
  const verdict_t v = {.value = {0.53 * share}, .stderr_ = {0.001, 0.001, 0.001}}; // twice that is too much
  CHECK(!beyond_control(&g.round, &with, &v, false));
  CHECK(beyond_control(&g.round, &with, &v, true));
  g.flight.rate_Hz = 100.0; // it misses commands: nobody knows what these explain
  CHECK(!beyond_control(&g.round, &with, &v, true));
  gap_rows_free(&g);
}

// Of a channel that is left out no size is known that shows there alone: the others are.
TEST(gap_score_goes_by_the_sizes_that_are_shown) {
  static const struct {
    const char *what;
    int shown; // of the sizes
    bool enters;
  } row[] = {{"one of three", 1, true}, {"none", 0, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 7);
    const int of = gap_rows_candidate(&g, "accel_bias");
    gap_rows_white(&g, gap_rows_column(&g, of, 0, CH_FX));
    for (int k = 0; k < GAP_ROWS; k++) g.residual[CH_FX][k] += gap_rows_column(&g, of, 0, CH_FX)[k];
    for (int k = 0; k < GAP_ROWS && !row[i].shown; k++) gap_rows_column(&g, of, 0, CH_FX)[k] = 0.0;
    gap_rows_open(&g, 0, NULL);
    const choice_t with = choice_with(&NONE, of);
    const verdict_t v = score_last(&g.round.score, &with);
    CHECK(score_allows(&g.round.score, &with, &v) == row[i].enters);
    CHECK((v.stderr_[0] > 0.0) == (row[i].shown > 0));
    for (int k = 1; k < 3; k++) CHECK(v.value[k] == 0.0 && v.stderr_[k] == 0.0);
    gap_rows_free(&g);
  }
}

// Of a few nominal flights the rms is not known well: so much more is asked for.
TEST(gap_score_asks_for_more_where_few_nominal_flights_could_be_flown) {
  static const struct {
    int flights;
    double bound; // root of the F distribution's upper hundredth, of a table
  } row[] = {{10, 3.169}, {3, 5.841}, {2, 9.925}, {0, 3.169}}; // none: as of the ten that are flown
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d flights", row[i].flights);
    CHECK_NEAR(limits_nominal(row[i].flights), row[i].bound, 2e-3);
  }
}

// Strong and then weak columns, by half-flight. What each gains with the number that the others have, over
// the root of the sum of squares: 2 where all are alike, and else as told.
TEST(gap_score_is_not_sure_of_what_one_half_flight_alone_shows) {
  static const struct {
    const char *what;
    double column[4], size[4];
    bool sure;
  } row[] = {{"everywhere", {1.0, 1.0, 1.0, 1.0}, {1.0, 1.0, 1.0, 1.0}, true},
             {"in one of four", {1.0, 0.02, 0.02, 0.02}, {1.0, 0.0, 0.0, 0.0}, false},
             {"in three, 1.12", {1.0, 0.15, 0.15, 0.15}, {1.0, 1.0, 0.0, 1.0}, true},
             {"in two, 0.78", {1.0, 0.15, 0.15, 0.15}, {1.0, 1.0, 0.0, 0.0}, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 8);
    const int of = along_x(&g, "rotor_drag", 1000.0);
    double *const x = gap_rows_column(&g, of, 0, CH_FX);
    for (int k = 0; k < GAP_ROWS; k++) {
      x[k] *= sqrt(row[i].column[4 * k / GAP_ROWS]);
      g.residual[CH_FX][k] += row[i].size[4 * k / GAP_ROWS] * x[k];
    }
    gap_rows_open(&g, 0, NULL);
    const choice_t with = choice_with(&NONE, of);
    CHECK(score_is_sure(&g.round.score, &NONE, &with) == row[i].sure);
    gap_rows_free(&g);
  }
}

// A column that is right in forces and of the wrong sign in turning does harm there.
TEST(gap_score_sees_harm_in_one_group_of_channels) {
  for (int sign = -1; sign <= 1; sign += 2) {
    gap_rows_t g;
    ROW("sign %d", sign);
    gap_rows_make(&g, 9);
    const int of = along_x(&g, "flapping", 60.0);
    gap_rows_add(&g, of, 0, 1.0);
    double *const turn = gap_rows_column(&g, of, 0, CH_WX);
    gap_rows_white(&g, turn);
    for (int i = 0; i < GAP_ROWS; i++) turn[i] *= 0.5;
    for (int i = 0; i < GAP_ROWS; i++) g.residual[CH_WX][i] += sign * turn[i];
    gap_rows_open(&g, 0, NULL);
    const choice_t with = choice_with(&NONE, of);
    CHECK(score_harms(&g.round.score, &NONE, &with) == (sign < 0));
    gap_rows_free(&g);
  }
}

// A twentieth of what is left in the group and of what is taken elsewhere, and 9.2: of 3600 squares in
// turning 190, and beside a force of 900 squares 45 more, of 3600 squares 180. The noise is without the
// column's part, and what the column does of the wrong sign is two to three times its squares.
TEST(gap_score_takes_more_than_a_twentieth_for_harm) {
  static const struct {
    double sure, squares; // of the force in standard errors; of the moment
    bool harms;
  } row[] = {{30.0, 85.0, false}, {30.0, 150.0, true}, {60.0, 150.0, false}, {60.0, 250.0, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    double xx = 0.0, xy = 0.0;
    ROW("a force of %g standard errors, %g", row[i].sure, row[i].squares);
    gap_rows_make(&g, 9);
    const int of = along_x(&g, "flapping", row[i].sure);
    gap_rows_add(&g, of, 0, 1.0);
    double *const turn = gap_rows_column(&g, of, 0, CH_WX), *const noise = g.residual[CH_WX];
    gap_rows_white(&g, turn);
    for (int k = 0; k < GAP_ROWS; k++) xx += turn[k] * turn[k], xy += turn[k] * noise[k];
    const double size = sqrt(row[i].squares / xx);
    for (int k = 0; k < GAP_ROWS; k++) {
      noise[k] -= xy / xx * turn[k] + size * turn[k];
      turn[k] *= size;
    }
    gap_rows_open(&g, 0, NULL);
    const choice_t with = choice_with(&NONE, of);
    CHECK(score_harms(&g.round.score, &NONE, &with) == row[i].harms);
    gap_rows_free(&g);
  }
}

TEST(gap_score_tells_how_alike_two_effects_are) {
  gap_rows_t g;
  gap_rows_make(&g, 10);
  const int own = along_x(&g, "rotor_drag", 50.0), same = gap_rows_candidate(&g, "flapping"),
            half = gap_rows_candidate(&g, "climb_inflow"), other = along_x(&g, "translational_lift", 50.0);
  const double *const x = gap_rows_column(&g, own, 0, CH_FX);
  for (int i = 0; i < GAP_ROWS; i++) {
    gap_rows_column(&g, same, 0, CH_FX)[i] = 3.0 * x[i];
    gap_rows_column(&g, half, 0, CH_FX)[i] = x[i] + (i % 2 ? 1.0 : -1.0) * 50.0 / sqrt(GAP_ROWS);
  }
  gap_rows_add(&g, own, 0, 1.0);
  gap_rows_open(&g, 1, &own);
  const score_t *const s = &g.round.score;
  const choice_t *const choice = &g.round.choice;
  const choice_t with_same = choice_with(&NONE, same), with_half = choice_with(&NONE, half),
                 with_other = choice_with(&NONE, other);
  CHECK_NEAR(score_likeness(s, choice, own, &with_same), 1.0, 1e-6);
  CHECK_NEAR(score_likeness(s, choice, own, &with_half), 0.5, 0.06);
  CHECK_NEAR(score_likeness(s, choice, own, &with_other), 0.0, 0.02);
  CHECK_NEAR(score_alike(s, g.candidate[own].first, same), 1.0, 1e-6);
  CHECK_NEAR(score_alike(s, g.candidate[own].first, other), 0.0, 0.02);
  gap_rows_free(&g);
}

// A thrust scale lifts and turns, a mass lifts, and an inertia that is named, too, gives what the scale
// turns.
TEST(gap_score_takes_for_alike_what_is_alike_beside_the_other_names) {
  gap_rows_t g;
  gap_rows_make(&g, 11);
  const int scale = gap_rows_candidate(&g, "thrust_scale"), mass = gap_rows_candidate(&g, "mass"),
            inertia = gap_rows_candidate(&g, "inertia");
  double *const lift = gap_rows_column(&g, scale, 0, CH_FZ), *const turn =
                                                                 gap_rows_column(&g, scale, 0, CH_WX);
  gap_rows_white(&g, lift);
  gap_rows_white(&g, turn);
  memcpy(gap_rows_column(&g, mass, 0, CH_FZ), lift, GAP_ROWS * sizeof *lift);
  memcpy(gap_rows_column(&g, inertia, 0, CH_WX), turn, GAP_ROWS * sizeof *turn);
  gap_rows_add(&g, scale, 0, 1.0);
  gap_rows_open(&g, 1, &scale);
  const choice_t alone = choice_with(&NONE, mass), beside = choice_with(&NONE, inertia),
                 both = choice_with(&beside, mass);
  CHECK_NEAR(score_likeness(&g.round.score, &g.round.choice, scale, &alone), 0.5, 0.05);
  CHECK_NEAR(score_likeness(&g.round.score, &g.round.choice, scale, &both), 1.0, 1e-6);
  gap_rows_free(&g);
}

// One effect pulls along x and, fourteen standard errors strong, along y; the other along x alone, as a
// thrust scale and a mass do in force and turning.
TEST(gap_score_takes_for_a_rival_what_only_feedback_could_tell_apart) {
  static const struct {
    const char *what;
    double found; // of the one by each nominal flight, over what is typical
    bool rival;
  } row[] = {{"no nominal flights", 0.0, false},
             {"feedback makes nothing there", 0.02, false},
             {"feedback makes less there than tells them apart", 0.2, false},
             {"feedback makes more", 0.8, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    double found[2 * NOMINAL_FLIGHTS];
    ROW("%s", row[i].what);
    gap_rows_make(&g, 12);
    const int both = along_x(&g, "rotor_drag", 50.0), one = gap_rows_candidate(&g, "body_drag");
    double *const y = gap_rows_column(&g, both, 0, CH_FY);
    gap_rows_white(&g, y);
    for (int k = 0; k < GAP_ROWS; k++) {
      gap_rows_column(&g, one, 0, CH_FX)[k] = gap_rows_column(&g, both, 0, CH_FX)[k];
      y[k] *= 14.0 / sqrt(GAP_ROWS);
    }
    gap_rows_add(&g, both, 0, 1.0);
    for (int k = 0; k < 2 * NOMINAL_FLIGHTS; k++) found[k] = k % 2 ? 0.0 : row[i].found;
    if (row[i].found > 0.0) gap_rows_nominal(&g, NOMINAL_FLIGHTS, 100.0, found);
    gap_rows_open(&g, 1, &both);
    const choice_t with = choice_with(&NONE, one);
    CHECK(score_is_rival(&g.round.score, &g.round.choice, &with, 0.0) == row[i].rival);
    gap_rows_free(&g);
  }
}

// So much of a number takes so much from the sum of squares, to the digit.
TEST(gap_score_s_least_size_is_the_one_that_takes_the_gain) {
  gap_rows_t g;
  double size[FX_SIZE_MAX], b;
  gap_rows_make(&g, 11);
  const int of = along_x(&g, "rotor_drag", 50.0);
  gap_rows_open(&g, 0, NULL);
  const choice_t with = choice_with(&NONE, of);
  score_least_gain(&g.round.score, &with, 30.0, size);
  const double *const G = g.round.gram.total;
  CHECK_NEAR(size[0] * size[0] * G[0], 30.0, 1e-6);
  score_estimate(&g.round.score, &with, &b, NULL);
  CHECK_NEAR(score_fitted(&g.round.score, &NONE) - score_fitted(&g.round.score, &with), b * b * G[0], 1e-6);
  gap_rows_free(&g);
}

// Ten times what is typical is possible: so much holds a number back that a half-flight does not show.
TEST(gap_score_s_ridge_is_that_of_ten_times_what_is_typical) {
  gap_rows_t g;
  gap_rows_make(&g, 12);
  const int of = along_x(&g, "rotor_drag", 50.0);
  gap_rows_open(&g, 0, NULL);
  const double typical = g.candidate[of].typical[0];
  CHECK_NEAR(g.round.score.ridge[0] * typical * typical, 0.01, 1e-9);
  gap_rows_free(&g);
}
