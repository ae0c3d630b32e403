// test_gap_by_turns.c - stretches of a flight that are held out by turns.
#include "exam/flights.h"
#include "gap/diagnose.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <stdlib.h>

TEST(gap_turns_are_taken_every_two_seconds) {
  static const struct {
    double at_s; // since the flight's first point
    int turn;
  } row[] = {{0.0, 0}, {1.9, 0}, {2.1, 1}, {3.9, 1}, {4.1, 2}, {6.1, 0}, {16.5, 2}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("at %g s", row[i].at_s);
    grid_point_t point[2] = {{.t_s = 30.0}, {.t_s = 30.0 + row[i].at_s}};
    CHECK(by_turns_at(&(grid_t){.n = 2, .point = point}, 1) == row[i].turn);
  }
}

// Of 1, 2 and 3 in the blocks of the three turns, those that are not held out are told of.
TEST(gap_turns_do_not_know_what_they_are_held_against) {
  static const double of_turn[TURNS] = {1.0, 2.0, 3.0}, others[TURNS] = {2.5, 2.0, 1.5};
  gap_rows_t g;
  int turn[GAP_ROWS / 50];
  why_t why;
  gap_rows_make(&g, 11);
  const int mass = gap_rows_candidate(&g, "mass"), scale = gap_rows_candidate(&g, "thrust_scale");
  double *const x = gap_rows_column(&g, mass, 0, CH_FZ), *const once = gap_rows_column(&g, scale, 0, CH_FZ);
  gap_rows_white(&g, x);
  for (int i = 0; i < GAP_ROWS; i++) {
    turn[i / 50] = i / 50 % TURNS;
    once[i] = i / 50 == 7 && i % 50 < 45 ? 3.0 : 0.0; // in the second turn alone, white rows and all
    g.residual[CH_FZ][i] += of_turn[turn[i / 50]] * x[i] + 0.5 * once[i];
  }
  gap_rows_open(&g, 0, NULL);
  chosen_t own = {.n = 2, .of = {0, 1}, .use = {g.candidate[mass].use, g.candidate[scale].use}};
  for (int k = 0; k < TURNS; k++) {
    ROW("turn %d", k);
    CHECK_OK(by_turns_estimate(&g.round.score, turn, k, &own, &why));
    // Four standard errors of 800 rows; a column's slopes that differ are noise, too.
    CHECK_NEAR(fx_use_size(&own.use[0], 0) / g.candidate[mass].typical[0], others[k], 0.2);
    const double seen_once = fx_use_size(&own.use[1], 0) / g.candidate[scale].typical[0];
    if (k == 1)
      CHECK_NEAR(seen_once, 0.0, 1e-9);
    else
      CHECK(fabs(seen_once) > 0.1);
  }
  gap_rows_free(&g);
}

// A lone flight is fitted to its end, and what is told as held out is not what was fitted.
TEST(gap_fits_all_of_a_lone_flight_and_judges_it_by_turns) {
  model_t given, truth;
  gap_flight_t flight;
  diagnosis_t d;
  why_t why;
  CHECK_OK(exam_vehicle(&given, &why));
  truth = given;
  fx_use_t hidden = fx_use(fx_find("cg_offset"));
  hidden.p[0] = 0.0015;
  CHECK_OK(model_add_fx(&truth, &hidden, &why));
  const exam_flight_t order = {.truth = &truth, .seed = 71};
  CHECK_OK(exam_fly(&order, &flight, &why));
  const diagnose_job_t job = {.fit = &(gap_flights_t){&flight, 1}, .model = &given, .seed = 1};
  CHECK_OK(diagnose(&job, &d, &why));
  const rows_t *const r = &d.fit.smooth;
  CHECK(d.fit.grid[0].point[r->point[r->n - 1]].t_s > flight.t_s[flight.n - 1] - 0.5);
  CHECK(d.turns.n == TURNS && d.held.smooth.n == r->n);
  if (CHECK(d.found.n == 1 && d.found.chosen.use[0].fx == hidden.fx)) {
    for (int k = 0; k < TURNS; k++) {
      ROW("turn %d", k);
      const double x_m = d.turns.of[k].use[0].p[0];
      CHECK(x_m != d.found.chosen.use[0].p[0]);
      CHECK_NEAR(x_m, 0.0015, 0.0003);
    }
    double left = 0.0;
    for (int i = 0; i < r->n; i++) left += d.residual[CH_WY][i] * d.residual[CH_WY][i];
    CHECK(d.held_out.channel[CH_WY].after > sqrt(left / r->n));
  }
  diagnosis_free(&d);
  gap_flight_free(&flight);
}
