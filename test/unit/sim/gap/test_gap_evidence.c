// test_gap_evidence.c - sets by evidence, on rows that no flight made.
#include "gap/5_infer/evidence.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

// log of the integral of N(b; 0, 1/p) exp(h b - F b^2 / 2), twice its positive half where it has a sign.
static double by_integral(double F, double h, double p, bool positive) {
  double sum = 0.0;
  const double step = 1e-4;
  for (double b = positive ? 0.0 : -8.0; b < 8.0; b += step)
    sum += step * exp(h * b - 0.5 * F * b * b - 0.5 * p * b * b) * sqrt(p / 2.0 / 3.14159265358979) *
           (positive ? 2.0 : 1.0);
  return log(sum);
}

TEST(gap_evidence_is_the_integral_over_the_prior) {
  static const struct {
    double F, h, p;
    bool positive;
  } row[] = {{20.0, 15.0, 1.0, false}, {20.0, 15.0, 0.25, true},  {20.0, -3.0, 1.0, true},
             {0.0, 0.0, 4.0, false},   {50.0, 80.0, 0.25, false}, {5.0, 0.0, 1.0, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%u", i);
    double F = row[i].F, h = row[i].h;
    const information_t f = {.n = 1, .F = &F, .h = &h};
    const int column = 0;
    CHECK_NEAR(evidence_log(&f, 1, &column, &row[i].p, &row[i].positive),
               by_integral(F, h, row[i].p, row[i].positive), 2e-3);
  }
  // Two numbers that do not know of each other: logarithms add.
  double F[] = {20.0, 0.0, 0.0, 7.0}, h[] = {9.0, -4.0};
  const information_t both = {.n = 2, .F = F, .h = h};
  const int column[] = {0, 1};
  const double p[] = {1.0, 0.25};
  const bool sign[] = {true, false};
  CHECK_NEAR(evidence_log(&both, 2, column, p, sign),
             by_integral(20.0, 9.0, 1.0, true) + by_integral(7.0, -4.0, 0.25, false), 4e-3);
  CHECK(evidence_log(&both, 0, column, p, sign) == 0.0);
}

// F^-1 = A^-1 + what feedback makes + misfit.
TEST(gap_information_holds_what_feedback_makes_with_its_correlations) {
  gap_rows_t g;
  why_t why;
  information_t f;
  gap_rows_make(&g, 21);
  (void)gap_rows_along(&g, "rotor_drag", CH_FX, 200.0);
  (void)gap_rows_along(&g, "flapping", CH_FY, 200.0);
  // Two nominal flights: half of each together, then the first alone.
  gap_rows_nominal(&g, 2, 1e8, (const double[]){0.5, 0.5, 0.3, 0.0});
  gap_rows_open(&g, 0, NULL);
  if (!CHECK_OK(information_make(&f, &g.round, &why))) return;
  const double det = f.F[0] * f.F[3] - f.F[1] * f.F[2];
  const double var0 = f.F[3] / det, var1 = f.F[0] / det, both = -f.F[1] / det;
  CHECK_NEAR(both, 0.5 * 0.5 / 2.0, 0.02); // as the mean of b b'
  CHECK(var0 > (0.25 + 0.09) / 2.0 && var1 > 0.25 / 2.0);
  CHECK(var0 < 3.0 * (0.25 + 0.09) / 2.0);
  CHECK_NEAR(f.F[1], f.F[2], 1e-9 * fabs(f.F[1]));
  information_free(&f);
  gap_rows_free(&g);
}

TEST(gap_information_widens_by_misfit_and_by_slow_noise) {
  for (int slow = 0; slow < 2; slow++) {
    gap_rows_t g;
    why_t why;
    information_t f;
    ROW("%s", slow ? "sign of the residual by block" : "white");
    gap_rows_make(&g, 22);
    const int of = gap_rows_along(&g, "rotor_drag", CH_FX, 1000.0);
    // A part of the column comes and goes from block to block, as noise that is no noise of rows.
    const double *const x = gap_rows_column(&g, of, 0, CH_FX);
    for (int i = 0; i < GAP_ROWS && slow; i++) g.residual[CH_FX][i] += (i / 50 % 2 ? 0.3 : -0.3) * x[i];
    gap_rows_nominal(&g, 0, 0.0, NULL);
    gap_rows_open(&g, 0, NULL);
    if (!CHECK_OK(information_make(&f, &g.round, &why))) return;
    const double sd = 1.0 / sqrt(f.F[0]);
    if (slow)
      CHECK_NEAR(sd, 0.3 / sqrt(GAP_ROWS / 50.0), 0.03);
    else
      CHECK_NEAR(sd, 0.02, 0.004);
    information_free(&f);
    gap_rows_free(&g);
  }
}

// Two hundredths of what is typical, as one form or as five of which each could stand for the others.
TEST(gap_information_knows_one_misfit_of_an_effect_however_many_its_forms) {
  for (int forms = 1; forms <= 5; forms += 4) {
    gap_rows_t g;
    why_t why;
    information_t f;
    ROW("%d", forms);
    gap_rows_make(&g, 29);
    const int first = gap_rows_along(&g, "ground", CH_FZ, 2000.0);
    for (int k = 1; k < forms; k++) {
      double *const x = gap_rows_column(&g, gap_rows_candidate(&g, "ground"), 0, CH_FZ);
      for (int i = 0; i < GAP_ROWS; i++) x[i] = gap_rows_column(&g, first, 0, CH_FZ)[i];
    }
    gap_rows_nominal(&g, 0, 0.0, NULL);
    gap_rows_open(&g, 0, NULL);
    if (!CHECK_OK(information_make(&f, &g.round, &why))) return;
    CHECK_NEAR(1.0 / sqrt(f.F[0]), 0.02, 0.001);
    information_free(&f);
    gap_rows_free(&g);
  }
}

// What missed commands did looks like an inertia: a quarter of what is typical is no information there. Nor
// is 0.15 of the 5 ms from which on a delay is named, beside two hundredths of what is typical.
TEST(gap_information_holds_little_of_an_inertia_in_slow_rows_and_of_lateness) {
  static const struct {
    const char *name;
    double rate_Hz, late_s, misfit;
  } row[] = {
      {"inertia", 500.0, 0.0, 0.02}, {"inertia", 100.0, 0.0, 0.25}, {"delay", 500.0, 0.15 * 0.005, 0.02}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    why_t why;
    information_t f;
    ROW("%s at %.0f Hz", row[i].name, row[i].rate_Hz);
    gap_rows_make(&g, 26);
    g.flight.rate_Hz = row[i].rate_Hz;
    const int of = gap_rows_along(&g, row[i].name, CH_WX, 2000.0);
    gap_rows_nominal(&g, 0, 0.0, NULL);
    gap_rows_open(&g, 0, NULL);
    if (!CHECK_OK(information_make(&f, &g.round, &why))) return;
    const double sd = hypot(row[i].misfit, row[i].late_s / g.candidate[of].typical[0]);
    CHECK_NEAR(1.0 / sqrt(f.F[0]), sd, 0.05 * sd);
    information_free(&f);
    gap_rows_free(&g);
  }
}

// Of two columns F^-1 has the nominal flights' mean of b b', and each column's mean square beside. Of what
// control commands it has that once more.
TEST(gap_information_takes_of_another_pilot_s_feedback_only_how_large_it_gets) {
  static const struct {
    const char *name[2];
    double times; // of the first one's mean square
  } row[] = {{{"rotor_drag", "flapping"}, 2.0}, {{"torque_ratio", "flapping"}, 3.0}};
  for (int i = 0; i < 2; i++) {
    gap_rows_t g;
    why_t why;
    information_t f;
    ROW("%s", row[i].name[0]);
    gap_rows_make(&g, 31);
    (void)gap_rows_along(&g, row[i].name[0], CH_WZ, 2000.0);
    (void)gap_rows_along(&g, row[i].name[1], CH_FY, 2000.0);
    gap_rows_nominal(&g, 2, 1e8, (const double[]){2.0, -1.0, 2.0, -1.0});
    gap_rows_open(&g, 0, NULL);
    if (!CHECK_OK(information_make(&f, &g.round, &why))) return;
    const double det = f.F[0] * f.F[3] - f.F[1] * f.F[2];
    CHECK_NEAR(f.F[3] / det, row[i].times * 4.0, 0.2);
    CHECK_NEAR(f.F[0] / det, 2.0, 0.1);
    CHECK_NEAR(-f.F[1] / det, -2.0, 0.1);
    information_free(&f);
    gap_rows_free(&g);
  }
}

// One effect in a hundred is there, and is a half, once, twice or four times what is typical.
TEST(gap_evidence_weighs_four_scales_and_how_rare_an_effect_is) {
  gap_rows_t g;
  why_t why;
  evidence_t e;
  information_t f;
  gap_rows_make(&g, 27);
  const int of = gap_rows_along(&g, "rotor_drag", CH_FX, 20.0), column = 0;
  gap_rows_add(&g, of, 0, 3.0);
  gap_rows_nominal(&g, 0, 0.0, NULL);
  gap_rows_open(&g, 0, NULL);
  if (!CHECK_OK(information_make(&f, &g.round, &why)) || !CHECK_OK(evidence_make(&e, &g.round, &why))) return;
  double sum = 0.0;
  for (double scale = 0.5; scale <= 4.0; scale *= 2.0) {
    const double p = 1.0 / (scale * scale);
    sum += exp(evidence_log(&f, 1, &column, &p, &(const bool){true})) / 4.0;
  }
  CHECK(e.n == 2 && e.set[0].n == 1);
  CHECK_NEAR(e.set[0].log, log(sum) + log(0.01), 1e-6);
  information_free(&f);
  evidence_free(&e);
  gap_rows_free(&g);
}

// Of nine effects there are 84 sets of three. Sixteen pairs are extended by seven each, and of what that
// makes sixteen again.
TEST(gap_evidence_extends_the_sixteen_best_sets_of_a_size) {
  static const char *const name[] = {"rotor_drag",         "flapping",     "climb_inflow",
                                     "translational_lift", "body_drag",    "mass",
                                     "battery_sag",        "thrust_curve", "imu_misalignment"};
  gap_rows_t g;
  why_t why;
  evidence_t e;
  int of_size[EVIDENCE_DEPTH + 1] = {0};
  gap_rows_make(&g, 28);
  for (int k = 0; k < 9; k++) (void)gap_rows_along(&g, name[k], CH_FX + k % 3, 20.0);
  gap_rows_nominal(&g, 0, 0.0, NULL);
  gap_rows_open(&g, 0, NULL);
  if (!CHECK_OK(evidence_make(&e, &g.round, &why))) return;
  for (int i = 0; i < e.n; i++) of_size[e.set[i].n]++;
  CHECK(of_size[1] == 9 && of_size[2] == 36);
  CHECK_NEAR(of_size[3], 66, 4); // of ten pairs 55, of twenty-four more than 70
  evidence_free(&e);
  gap_rows_free(&g);
}

// Of a channel that is left out some of an effect's sizes have no column: the others speak for it.
TEST(gap_evidence_speaks_for_an_effect_by_the_sizes_that_are_shown) {
  static const struct {
    const char *what;
    int shown;
    bool there;
  } row[] = {{"all three", 3, true}, {"two of three", 2, true}, {"one", 1, true}, {"none", 0, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    why_t why;
    evidence_t e;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 24);
    const int of = gap_rows_along(&g, "accel_bias", CH_FX, 20.0);
    for (int k = 0; k < row[i].shown; k++) gap_rows_add(&g, of, k, 3.0);
    for (int k = row[i].shown; k < 3; k++)
      memset(gap_rows_column(&g, of, k, CH_FX + k), 0, GAP_ROWS * sizeof(double));
    gap_rows_nominal(&g, 0, 0.0, NULL);
    gap_rows_open(&g, 0, NULL);
    if (!CHECK_OK(evidence_make(&e, &g.round, &why))) return;
    CHECK((e.set[0].n == 1) == row[i].there);
    evidence_free(&e);
    gap_rows_free(&g);
  }
}

TEST(gap_evidence_finds_a_set_and_leaves_the_rest_out) {
  static const struct {
    const char *what;
    double size[4];
    const char *set;
    double in_file; // of the third, over what is typical: so much of it can go
  } row[] = {{"nothing", {0.0, 0.0, 0.0, 0.0}, "", 0.0},
             {"one", {0.0, 1.0, 0.0, 0.0}, "1", 0.0},
             {"two", {0.8, 0.0, 2.0, 0.0}, "02", 0.0},
             {"of a sign that it cannot have", {0.0, 0.0, -2.0, 0.0}, "", 0.0},
             {"less of what the file has", {0.0, 0.0, -2.0, 0.0}, "2", 4.0},
             {"three", {1.0, 1.0, 1.0, 0.0}, "012", 0.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    why_t why;
    evidence_t e;
    char set[8] = "";
    ROW("%s", row[i].what);
    gap_rows_make(&g, 23);
    static const char *const name[] = {"rotor_drag", "flapping", "climb_inflow", "translational_lift"};
    for (int k = 0; k < 4; k++)
      gap_rows_add(&g, gap_rows_along(&g, name[k], CH_FX + k, 20.0), 0, row[i].size[k]);
    g.candidate[2].least[0] = -row[i].in_file;
    gap_rows_nominal(&g, 0, 0.0, NULL);
    gap_rows_open(&g, 0, NULL);
    if (!CHECK_OK(evidence_make(&e, &g.round, &why))) return;
    for (int k = 0; k < e.set[0].n && k < 7; k++) set[k] = (char)('0' + e.set[0].of[k]), set[k + 1] = '\0';
    CHECK_TEXT(set, row[i].set);
    CHECK(e.set[0].share > 0.8);
    double sum = 0.0;
    for (int k = 0; k < e.n; k++) sum += e.set[k].share;
    CHECK_NEAR(sum, 1.0, 1e-9);
    evidence_free(&e);
    gap_rows_free(&g);
  }
}

// Two names for the same columns share the probability; together they are sure.
TEST(gap_evidence_of_alike_effects_is_shared) {
  gap_rows_t g;
  why_t why;
  evidence_t e;
  gap_rows_make(&g, 24);
  const int own = gap_rows_along(&g, "rotor_drag", CH_FX, 30.0), twin = gap_rows_candidate(&g, "flapping");
  for (int i = 0; i < GAP_ROWS; i++)
    gap_rows_column(&g, twin, 0, CH_FX)[i] = gap_rows_column(&g, own, 0, CH_FX)[i];
  gap_rows_add(&g, own, 0, 1.0);
  gap_rows_nominal(&g, 0, 0.0, NULL);
  gap_rows_open(&g, 0, NULL);
  if (!CHECK_OK(evidence_make(&e, &g.round, &why))) return;
  const int both[] = {own, twin};
  CHECK(evidence_of(&e, &g.candidates, 2, both) > 0.99);
  for (int i = 0; i < 2; i++) CHECK_NEAR(evidence_of(&e, &g.candidates, 1, both + i), 0.5, 0.2);
  evidence_free(&e);
  gap_rows_free(&g);
}

// Flights in which five forms of an effect look alike say as much for it as if it had one.
TEST(gap_evidence_speaks_for_an_effect_in_any_of_its_forms) {
  double by_forms[2];
  for (int many = 0; many < 2; many++) {
    gap_rows_t g;
    why_t why;
    double odds[NAMED_MAX];
    gap_rows_make(&g, 31);
    const int first = gap_rows_along(&g, "ground", CH_FZ, 20.0);
    gap_rows_add(&g, first, 0, 0.5);
    for (int k = 0; k < 4 * many; k++) {
      double *const x = gap_rows_column(&g, gap_rows_candidate(&g, "ground"), 0, CH_FZ);
      for (int i = 0; i < GAP_ROWS; i++) x[i] = gap_rows_column(&g, first, 0, CH_FZ)[i];
    }
    gap_rows_nominal(&g, 0, 0.0, NULL);
    gap_rows_open(&g, 1, &first);
    if (!CHECK_OK(evidence_odds(&g.round, odds, &why))) return;
    by_forms[many] = odds[0];
    gap_rows_free(&g);
  }
  CHECK(by_forms[0] > 10.0);
  CHECK_NEAR(by_forms[1], by_forms[0], 0.1); // one form alone would have a fifth of the prior, 1.6 less
}

TEST(gap_evidence_is_never_more_than_sure) {
  candidate_t candidate = {.use.fx = fx_find("rotor_drag")};
  const candidates_t c = {.n = 1, .candidate = &candidate};
  evidence_set_t set[2] = {{.n = 1, .share = 0.5}, {.n = 1, .share = 0.5 + 1e-15}};
  const evidence_t e = {2, set};
  CHECK(evidence_of(&e, &c, 1, &(const int){0}) == 1.0);
}

TEST(gap_evidence_knows_the_likeliest_set_without_an_effect) {
  candidate_t candidate[] = {
      {.use.fx = fx_find("body_drag")}, {.use.fx = fx_find("rotor_drag")}, {.use.fx = fx_find("mass")}};
  const candidates_t c = {.n = 3, .candidate = candidate};
  evidence_set_t set[] = {{2, {1, 2}, .share = 0.7}, {2, {0, 2}, .share = 0.2}, {1, {1}, .share = 0.1}};
  const evidence_t e = {3, set};
  const int drags[] = {1, 0};
  CHECK(evidence_without(&e, &c, 1, drags + 1) == &set[0]);
  CHECK(evidence_without(&e, &c, 1, drags) == &set[1]);
  CHECK(evidence_without(&e, &c, 2, drags) == NULL);
}

// A sure error of the accelerometer along x says nothing of one along z.
TEST(gap_evidence_of_one_lot_of_an_effect_s_numbers_is_not_the_other_s) {
  const fx_t *const bias = fx_find("accel_bias");
  candidate_t candidate[] = {
      {.use.fx = bias, .to = 2}, {.use.fx = bias, .from = 2, .to = 3}, {.use.fx = fx_find("battery_sag")}};
  const candidates_t c = {.n = 3, .candidate = candidate};
  evidence_set_t set[] = {{2, {0, 2}, .share = 0.7}, {2, {0, 1}, .share = 0.3}};
  const evidence_t e = {2, set};
  CHECK_NEAR(evidence_of(&e, &c, 1, &(const int){0}), 1.0, 1e-12);
  CHECK_NEAR(evidence_of(&e, &c, 1, &(const int){1}), 0.3, 1e-12);
  CHECK(evidence_without(&e, &c, 1, &(const int){1}) == &set[0]);
}

// What feedback alone makes as much of is no evidence, however far it is from noise.
TEST(gap_evidence_does_not_speak_for_what_feedback_makes) {
  static const struct {
    const char *what;
    double feedback; // rms on nominal flights, over what is typical
    bool there;
  } row[] = {{"a tenth of it", 0.05, true}, {"as much", 0.5, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    why_t why;
    double odds[NAMED_MAX];
    ROW("%s", row[i].what);
    gap_rows_make(&g, 25);
    const int of = gap_rows_along(&g, "rotor_drag", CH_FX, 100.0),
              other = gap_rows_along(&g, "flapping", CH_FY, 100.0);
    gap_rows_add(&g, of, 0, 0.5);
    gap_rows_add(&g, other, 0, 1.0);
    const double b = row[i].feedback;
    gap_rows_nominal(&g, 4, 1e8, (const double[]){b, 0.0, -b, 0.0, b, 0.0, -b, 0.0});
    gap_rows_open(&g, 2, (const int[]){of, other});
    if (!CHECK_OK(evidence_odds(&g.round, odds, &why))) return;
    CHECK((odds[0] > 0.0) == row[i].there);
    CHECK(odds[1] > 0.0);
    gap_rows_free(&g);
  }
}
