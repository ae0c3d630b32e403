// test_gap_family.c - which effects could stand in a name's place, of rows that no flight made.
#include "gap/5_infer/family.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

static const timing_t UNTIMED = {.candidate = -1};

// So strong that a typical one has `sure` standard errors.
static double *white_column(gap_rows_t *g, int candidate, int channel, double sure) {
  double *const x = gap_rows_column(g, candidate, 0, channel);
  gap_rows_white(g, x);
  for (int k = 0; k < GAP_ROWS; k++) x[k] *= sure / sqrt(GAP_ROWS);
  return x;
}

// What it does of `like`, and so many standard errors of something else: no two effects are quite the same.
static void nearly(gap_rows_t *g, int candidate, int channel, const double *like, double times) {
  double *const x = white_column(g, candidate, channel, 1.0);
  for (int k = 0; k < GAP_ROWS; k++) x[k] += times * like[k];
}

// What is said of a choice; before: its names without their rivals.
static bool describe(gap_rows_t *g, int n, const int *chosen, found_t *before, found_t *found) {
  why_t why;
  gap_rows_open(g, n, chosen);
  if (!CHECK_OK(found_make(found, &g->candidates, &why))) return false;
  found_describe(found, &g->round, &UNTIMED);
  *before = *found;
  return CHECK_OK(family_find(&g->round, false, found, &why));
}

static const named_t *named(const found_t *f, int candidate) {
  for (int i = 0; i < f->n; i++)
    if (f->named[i].candidate == candidate) return &f->named[i];
  return NULL;
}

static bool has_rival(const named_t *n, const char *effect) {
  for (int k = 0; n && k < n->n_rival; k++)
    if (strcmp(n->rival[k]->name, effect) == 0) return true;
  return false;
}

// Drag of the rotors or of the body: what only one of them does along x looks like a little wind. Which of
// the two it is nobody knows, and so neither how much wind there is.
TEST(gap_is_less_sure_of_a_number_that_goes_with_another_name_s_rival) {
  static const struct {
    const char *what;
    double wind; // of it that the rival does besides
  } row[] = {{"a rival that does the same", 0.0}, {"a rival that does some of it, too", 0.05}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gap_rows_t g;
    found_t before, found;
    gap_rows_make(&g, 20);
    const int drag = gap_rows_candidate(&g, "rotor_drag"), rival = gap_rows_candidate(&g, "body_drag"),
              wind = gap_rows_candidate(&g, "wind");
    const double *const x = white_column(&g, drag, CH_FX, 50.0), *const w =
                                                                     white_column(&g, wind, CH_FY, 50.0);
    nearly(&g, rival, CH_FX, x, 1.0);
    nearly(&g, rival, CH_FY, w, row[i].wind);
    gap_rows_add(&g, drag, 0, 1.0);
    gap_rows_add(&g, wind, 0, 1.0);
    if (describe(&g, 2, (int[]){drag, wind}, &before, &found)) {
      const named_t *const was = named(&before, wind), *const is = named(&found, wind);
      CHECK(has_rival(named(&found, drag), "body_drag"));
      if (CHECK(was && is)) {
        const double typical = g.candidate[wind].typical[0], half = 0.5 * row[i].wind * typical; // of its way
        CHECK_NEAR(is->stderr_[0] / hypot(was->stderr_[0], half), 1.0, 0.05);
        CHECK_NEAR(is->beside[0], hypot(was->beside[0], half), 0.002 * typical);
        CHECK(is->value[0] == was->value[0]);
      }
    }
    found_free(&found);
    gap_rows_free(&g);
  }
}

// A weak rotor and a thrust scale look alike; mass differs from the scale in turning alone.
TEST(gap_tells_mass_beside_a_thrust_scale_that_stands_for_a_name_where_the_log_misses_commands) {
  static const struct {
    const char *what;
    double rate_Hz;
    bool mass;
  } row[] = {{"all commands", 500.0, false}, {"one of five", 100.0, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gap_rows_t g;
    found_t before, found;
    gap_rows_make(&g, 21);
    g.flight.rate_Hz = row[i].rate_Hz;
    g.grid.command_Hz = 500.0;
    const int weak = gap_rows_candidate(&g, "motor_damage"), scale = gap_rows_candidate(&g, "thrust_scale"),
              mass = gap_rows_candidate(&g, "mass");
    const double *const z = white_column(&g, weak, CH_FZ, 50.0), *const turning =
                                                                     white_column(&g, weak, CH_WX, 50.0);
    nearly(&g, scale, CH_FZ, z, 1.0);
    nearly(&g, scale, CH_WX, turning, 1.0);
    nearly(&g, mass, CH_FZ, z, 1.0);
    gap_rows_add(&g, weak, 0, 1.0);
    if (describe(&g, 1, &weak, &before, &found)) {
      CHECK(has_rival(named(&found, weak), "thrust_scale"));
      CHECK(has_rival(named(&found, weak), "mass") == row[i].mass);
    }
    found_free(&found);
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
    found_t before, found;
    gap_rows_make(&g, 22);
    const int drag = gap_rows_candidate(&g, "rotor_drag"), rival = gap_rows_candidate(&g, "body_drag");
    nearly(&g, rival, CH_FX, white_column(&g, drag, CH_FX, row[i].sure), 1.0);
    white_column(&g, rival, CH_FY, 30.0);
    gap_rows_add(&g, drag, 0, 1.0);
    if (describe(&g, 1, &drag, &before, &found))
      CHECK(has_rival(named(&found, drag), "body_drag") == row[i].rival);
    found_free(&found);
    gap_rows_free(&g);
  }
}
