// test_gap_family.c - which effects could stand in a name's place, of rows that no flight made.
#include "gap/5_infer/family.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

static const timing_t UNTIMED = {.candidate = -1};

// So strong that a typical one has `sure` standard errors.
static double *white_column(gap_rows_t *g, int candidate, int k, int channel, double sure) {
  double *const x = gap_rows_column(g, candidate, k, channel);
  gap_rows_white(g, x);
  for (int i = 0; i < GAP_ROWS; i++) x[i] *= sure / sqrt(GAP_ROWS);
  return x;
}

// What it does of `like`, and so many standard errors of something else: no two effects are quite the same.
static void nearly(gap_rows_t *g, int candidate, int channel, const double *like, double times,
                   double else_) {
  double *const x = white_column(g, candidate, 0, channel, else_);
  for (int i = 0; i < GAP_ROWS; i++) x[i] += times * like[i];
}

static bool describe(gap_rows_t *g, int n, const int *chosen, found_t *found) {
  why_t why;
  gap_rows_open(g, n, chosen);
  if (!CHECK_OK(found_make(found, &g->candidates, &why))) return false;
  if (!CHECK_OK(found_describe(found, &g->round, &UNTIMED, &why))) return false;
  return CHECK_OK(family_find(&g->round, false, found, &why));
}

static named_t *named(found_t *f, int candidate) {
  for (int i = 0; i < f->n; i++)
    if (f->named[i].candidate == candidate) return &f->named[i];
  return NULL;
}

static bool has_rival(const named_t *n, const char *effect) {
  for (int k = 0; n && k < n->n_rival; k++)
    if (strcmp(n->rival[k]->name, effect) == 0) return true;
  return false;
}

// half: of the way that the first number moves, over what is typical; nothing else moves.
static void check_moves(const gap_rows_t *g, found_t *found, int moves, int stays, double half) {
  named_t *const is = named(found, moves), *const other = named(found, stays);
  if (!CHECK(is && other)) return;
  const named_t was = *is;
  CHECK_NEAR(is->by_rivals[0] / g->candidate[moves].typical[0], half, 0.003);
  for (int k = 0; k < g->candidate[stays].n; k++)
    CHECK(other->by_rivals[k] < 0.02 * g->candidate[stays].typical[k]);
  found_join_rivals(found);
  CHECK_NEAR(is->stderr_[0], hypot(was.stderr_[0], was.by_rivals[0]), 1e-12);
  CHECK(!(is->stderr_[1] > 0.0)); // not shown
}

// Drag of the rotors or of the body, or flapping: what they do along x, each as well, looks like a little
// wind. Which of them it is nobody knows, and so neither how much wind there is; what an accelerometer adds
// to z, of three numbers, has nothing to do with it.
TEST(gap_is_less_sure_of_a_number_that_goes_with_another_name_s_rival) {
  static const struct {
    const char *what;
    double body, flapping; // of the wind that each does besides
  } row[] = {{"rivals that do the same", 0.0, 0.0},
             {"the first does some of it, too", 0.05, 0.02},
             {"the second does", 0.02, 0.05}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gap_rows_t g;
    found_t found;
    gap_rows_make(&g, 20);
    const int bias = gap_rows_candidate(&g, "accel_bias"), drag = gap_rows_candidate(&g, "rotor_drag"),
              body = gap_rows_candidate(&g, "body_drag"), flapping = gap_rows_candidate(&g, "flapping"),
              wind = gap_rows_candidate(&g, "wind");
    const double *const x = white_column(&g, drag, 0, CH_FX, 50.0), *const w = white_column(&g, wind, 0,
                                                                                            CH_FY, 50.0);
    for (int k = 0; k < 3; k++) {
      white_column(&g, bias, k, CH_FZ, 50.0);
      gap_rows_add(&g, bias, k, 1.0 + k);
    }
    nearly(&g, body, CH_FX, x, 1.0, 1.0);
    nearly(&g, body, CH_FY, w, row[i].body, 0.1);
    nearly(&g, flapping, CH_FX, x, 1.0, 1.0);
    nearly(&g, flapping, CH_FY, w, row[i].flapping, 0.1);
    gap_rows_add(&g, drag, 0, 1.0);
    gap_rows_add(&g, wind, 0, 1.0);
    if (describe(&g, 3, (int[]){bias, drag, wind}, &found)) {
      CHECK(has_rival(named(&found, drag), "body_drag") && has_rival(named(&found, drag), "flapping"));
      check_moves(&g, &found, wind, bias, 0.5 * fmax(row[i].body, row[i].flapping));
    }
    found_free(&found);
    gap_rows_free(&g);
  }
}

// With the rival inflow would be taken at the hubs and not at the centre of mass: of the one that is told the
// number moves all the same.
TEST(gap_is_less_sure_of_a_number_that_a_rival_would_give_another_form) {
  gap_rows_t g;
  found_t found;
  gap_rows_make(&g, 26);
  const int drag = gap_rows_candidate(&g, "rotor_drag"), body = gap_rows_candidate(&g, "body_drag"),
            inflow = gap_rows_candidate(&g, "climb_inflow"), other = gap_rows_candidate(&g, "climb_inflow");
  const double *const x = white_column(&g, drag, 0, CH_FX, 50.0), *const z = white_column(&g, inflow, 0,
                                                                                          CH_FZ, 50.0);
  nearly(&g, body, CH_FX, x, 1.0, 3.0);
  nearly(&g, body, CH_FZ, z, 0.05, 0.1);
  for (int i = 0; i < GAP_ROWS; i++) {
    gap_rows_column(&g, other, 0, CH_FZ)[i] = z[i];
    gap_rows_column(&g, other, 0, CH_FX)[i] = x[i] - gap_rows_column(&g, body, 0, CH_FX)[i];
  }
  gap_rows_add(&g, drag, 0, 1.0);
  gap_rows_add(&g, inflow, 0, 1.0);
  if (describe(&g, 2, (int[]){drag, inflow}, &found)) {
    const choice_t with = {2, {inflow, body}};
    CHECK(round_reshaped(&g.round, &with).of[0] == other);
    CHECK(has_rival(named(&found, drag), "body_drag"));
    CHECK_NEAR(named(&found, inflow)->by_rivals[0] / g.candidate[inflow].typical[0], 0.025, 0.003);
  }
  found_free(&found);
  gap_rows_free(&g);
}

// Drag is named though something that was refused explains more: what leaves nothing for the drag stands for
// it, what explains something else does not.
TEST(gap_takes_for_a_rival_what_fits_better_only_where_it_does_the_names_work) {
  static const struct {
    const char *what;
    double of_drag, else_; // what the other one does of what drag does, and besides, in standard errors
    bool rival;
  } row[] = {{"it does the same and more", 1.0, 60.0, true}, {"it does something else", 0.0, 80.0, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gap_rows_t g;
    found_t found;
    gap_rows_make(&g, 28);
    const int drag = gap_rows_candidate(&g, "rotor_drag"), wind = gap_rows_candidate(&g, "wind");
    const double *const x = white_column(&g, drag, 0, CH_FX, 50.0);
    nearly(&g, wind, CH_FX, x, row[i].of_drag, 0.1);
    white_column(&g, wind, 1, CH_FY, row[i].else_);
    gap_rows_add(&g, wind, 0, row[i].of_drag);
    gap_rows_add(&g, wind, 1, 1.0);
    gap_rows_add(&g, drag, 0, 1.0 - row[i].of_drag);
    if (describe(&g, 1, &drag, &found)) CHECK(has_rival(named(&found, drag), "wind") == row[i].rival);
    found_free(&found);
    gap_rows_free(&g);
  }
}

// A thrust scale lifts and turns, a mass lifts, and an inertia takes back what the scale turns: beside it the
// two are one.
TEST(gap_takes_for_a_rival_what_is_alike_beside_another_name) {
  for (int beside = 0; beside < 2; beside++) {
    ROW("%s", beside ? "an inertia is named, too" : "the scale alone is named");
    gap_rows_t g;
    found_t found;
    gap_rows_make(&g, 23);
    g.round.turning_told = true;
    const int scale = gap_rows_candidate(&g, "thrust_scale"), mass = gap_rows_candidate(&g, "mass"),
              inertia = gap_rows_candidate(&g, "inertia");
    nearly(&g, mass, CH_FZ, white_column(&g, scale, 0, CH_FZ, 50.0), 1.0, 4.0); // the rows prefer the scale
    nearly(&g, inertia, CH_WX, white_column(&g, scale, 0, CH_WX, 100.0), 1.0, 1.0);
    gap_rows_add(&g, scale, 0, 1.0);
    gap_rows_add(&g, inertia, 0, beside ? 1.0 : 0.0);
    if (describe(&g, 1 + beside, (int[]){scale, inertia}, &found))
      CHECK(has_rival(named(&found, scale), "mass") == (beside == 1));
    found_free(&found);
    gap_rows_free(&g);
  }
}

// Another name gives nearly the same, too, so that beside it the two are mostly what each has of its own.
TEST(gap_takes_for_a_rival_what_is_alike_alone) {
  gap_rows_t g;
  found_t found;
  gap_rows_make(&g, 24);
  const int drag = gap_rows_candidate(&g, "rotor_drag"), body = gap_rows_candidate(&g, "body_drag"),
            wind = gap_rows_candidate(&g, "wind");
  const double *const x = white_column(&g, drag, 0, CH_FX, 100.0);
  nearly(&g, body, CH_FX, x, 1.0, 1.0);
  nearly(&g, wind, CH_FX, x, 1.0, 1.0);
  white_column(&g, drag, 0, CH_FY, 4.0);
  gap_rows_add(&g, drag, 0, 1.0);
  gap_rows_add(&g, wind, 0, 1.0);
  if (describe(&g, 2, (int[]){drag, wind}, &found)) CHECK(has_rival(named(&found, drag), "body_drag"));
  found_free(&found);
  gap_rows_free(&g);
}

TEST(gap_takes_for_no_rival_what_would_have_to_be_less_than_nothing) {
  static const struct {
    double times;
    bool rival;
  } row[] = {{1.0, true}, {-1.0, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g times the drag", row[i].times);
    gap_rows_t g;
    found_t found;
    gap_rows_make(&g, 25);
    const int drag = gap_rows_candidate(&g, "rotor_drag"), body = gap_rows_candidate(&g, "body_drag");
    nearly(&g, body, CH_FX, white_column(&g, drag, 0, CH_FX, 50.0), row[i].times, 1.0);
    gap_rows_add(&g, drag, 0, 1.0);
    if (describe(&g, 1, &drag, &found)) CHECK(has_rival(named(&found, drag), "body_drag") == row[i].rival);
    found_free(&found);
    gap_rows_free(&g);
  }
}

// A weak rotor and a thrust scale look alike; mass differs from the scale in turning alone.
TEST(gap_tells_mass_beside_a_thrust_scale_that_stands_for_a_name_where_turning_does_not_tell_them_apart) {
  static const struct {
    const char *what;
    bool told, mass;
  } row[] = {{"it does", true, false}, {"it does not", false, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gap_rows_t g;
    found_t found;
    gap_rows_make(&g, 21);
    g.round.turning_told = row[i].told;
    const int weak = gap_rows_candidate(&g, "motor_damage"), scale = gap_rows_candidate(&g, "thrust_scale"),
              mass = gap_rows_candidate(&g, "mass");
    const double *const z = white_column(&g, weak, 0, CH_FZ, 50.0), *const turning = white_column(
                                                                        &g, weak, 0, CH_WX, 50.0);
    nearly(&g, scale, CH_FZ, z, 1.0, 1.0);
    nearly(&g, scale, CH_WX, turning, 1.0, 1.0);
    nearly(&g, mass, CH_FZ, z, 1.0, 1.0);
    gap_rows_add(&g, weak, 0, 1.0);
    if (describe(&g, 1, &weak, &found)) {
      CHECK(has_rival(named(&found, weak), "thrust_scale"));
      CHECK(has_rival(named(&found, weak), "mass") == row[i].mass);
    }
    found_free(&found);
    gap_rows_free(&g);
  }
}

// About z they are one; a log that misses commands does not tell what an inertia does about x and y.
TEST(gap_tells_an_inertia_beside_another_torque_where_the_log_misses_commands) {
  static const struct {
    const char *what;
    double rate_Hz;
    bool rival;
  } row[] = {{"all commands", 500.0, false}, {"one of five", 100.0, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gap_rows_t g;
    found_t found;
    gap_rows_make(&g, 27);
    g.flight.rate_Hz = row[i].rate_Hz;
    g.grid.command_Hz = 500.0;
    const int torque = gap_rows_candidate(&g, "torque_ratio"), inertia = gap_rows_candidate(&g, "inertia");
    const double *const z = white_column(&g, torque, 0, CH_WZ, 50.0);
    nearly(&g, inertia, CH_WZ, z, 1.0, 1.0);
    white_column(&g, inertia, 0, CH_WX, 50.0); // as large about x, of which the rows have nothing
    gap_rows_add(&g, torque, 0, 1.0);
    if (describe(&g, 1, &torque, &found)) CHECK(has_rival(named(&found, torque), "inertia") == row[i].rival);
    found_free(&found);
    gap_rows_free(&g);
  }
}

// A step that ends an ulp below the least mass is a vehicle that no model takes.
TEST(gap_takes_no_number_beyond_what_it_can_be) {
  gap_rows_t g;
  gap_rows_make(&g, 25);
  const int mass = gap_rows_candidate(&g, "mass");
  white_column(&g, mass, 0, CH_FZ, 50.0);
  gap_rows_add(&g, mass, 0, -1e3); // typical masses: more than there is
  gap_rows_open(&g, 1, &mass);
  for (int i = 1; i < 200; i++) {
    g.candidate[mass].least[0] = -0.0463596 + 1.2345e-6 * i;
    round_take(&g.round, 1.0);
    CHECK(fx_use_size(chosen_use(&g.round.chosen, mass), 0) >= g.candidate[mass].least[0]);
    fx_use_resize(chosen_take(&g.round.chosen, g.round.c, mass), 0, 1e-4 * i);
  }
  gap_rows_free(&g);
}

// They may both be named where the turning tells them apart: control makes of noise what looks like less than
// a typical inertia by 3.2 times its rms, and all commands are logged.
TEST(gap_names_mass_beside_a_thrust_scale_where_turning_is_told) {
  enum { FLIGHTS = 10, COLUMNS = 5 };
  static const struct {
    const char *what;
    double inertia[2], rate_Hz;
    int flights;
    bool both;
  } row[] = {{"little is made of noise", {0.30, 0.30}, 500.0, FLIGHTS, true},
             {"more about x", {0.33, 0.30}, 500.0, FLIGHTS, false},
             {"more about y", {0.30, 0.33}, 500.0, FLIGHTS, false},
             {"one command of five", {0.30, 0.30}, 100.0, FLIGHTS, false},
             {"nothing was flown", {0.30, 0.30}, 500.0, 0, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gap_rows_t g;
    double made[FLIGHTS * COLUMNS] = {0.0};
    gap_rows_make(&g, 24);
    g.flight.rate_Hz = row[i].rate_Hz;
    g.grid.command_Hz = 500.0;
    const int inertia = gap_rows_candidate(&g, "inertia"), mass = gap_rows_candidate(&g, "mass"),
              scale = gap_rows_candidate(&g, "thrust_scale");
    white_column(&g, inertia, 0, CH_WX, 50.0);
    white_column(&g, inertia, 1, CH_WY, 50.0);
    white_column(&g, mass, 0, CH_FZ, 50.0);
    for (int f = 0; f < FLIGHTS; f++)
      for (int k = 0; k < 2; k++) made[f * COLUMNS + k] = f % 2 ? -row[i].inertia[k] : row[i].inertia[k];
    gap_rows_nominal(&g, row[i].flights, 1e8, made);
    gap_rows_open(&g, 1, &mass);
    g.round.turning_told = round_tells_turning(&g.round);
    CHECK(g.round.turning_told == row[i].both);
    CHECK(round_fits(&g.round, &g.round.choice, scale) == row[i].both);
    gap_rows_free(&g);
  }
}

// What tells the two apart is thirty standard errors strong, and straight lines make as much of what is
// large.
TEST(gap_tells_nothing_apart_by_less_than_what_straight_lines_are_wrong_by) {
  static const struct {
    double sure; // of the name, in standard errors
    bool rival;
  } row[] = {{1000.0, false}, {2000.0, true}}; // 3 % of it, and 1.5 %
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("a name of %g standard errors", row[i].sure);
    gap_rows_t g;
    found_t found;
    gap_rows_make(&g, 22);
    const int drag = gap_rows_candidate(&g, "rotor_drag"), rival = gap_rows_candidate(&g, "body_drag");
    nearly(&g, rival, CH_FX, white_column(&g, drag, 0, CH_FX, row[i].sure), 1.0, 1.0);
    white_column(&g, rival, 0, CH_FY, 30.0);
    gap_rows_add(&g, drag, 0, 1.0);
    if (describe(&g, 1, &drag, &found)) CHECK(has_rival(named(&found, drag), "body_drag") == row[i].rival);
    found_free(&found);
    gap_rows_free(&g);
  }
}
