// test_gap_unknown.c - what of an unknown effect is told: beyond nominal flights and beyond a misfit, and
// which of those that explain as much.
#include "gap/5_infer/nominal_sums.h"
#include "rig/gap_track.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <math.h>

// Nominal flights in which one look finds much say nothing against another look.
TEST(gap_measures_each_look_by_the_same_in_nominal_flights) {
  scan_t log = {.cell = {{.statistic = 0.0}}}, nominal[NOMINAL_FLIGHTS];
  const double misfit[CHANNELS] = {[CH_FZ] = 0.02};
  judged_t judged;
  const int shaken = unknown_cell(CH_WX, COORDINATE_VEL_Z, false),
            quiet = unknown_cell(CH_FZ, COORDINATE_HEIGHT, false);
  for (int i = 0; i < NOMINAL_FLIGHTS; i++)
    for (int k = 0; k < UNKNOWN_CELLS; k++)
      nominal[i].cell[k].statistic = k == shaken ? 40.0 + 0.5 * i : 3.0 + 0.1 * i;
  for (int k = 0; k < UNKNOWN_CELLS; k++) log.cell[k] = (cell_t){.statistic = 3.5, .explained = 12.0};
  log.cell[shaken] = (cell_t){.channel = CH_WX, .statistic = 45.0, .explained = 2000.0};
  unknown_judge(&log, nominal, NOMINAL_FLIGHTS, misfit, &judged);
  CHECK(!judged.found);
  log.cell[quiet] = (cell_t){.channel = CH_FZ, .size = 0.5, .statistic = 12.0, .explained = 144.0};
  unknown_judge(&log, nominal, NOMINAL_FLIGHTS, misfit, &judged);
  CHECK(judged.found && judged.cell.channel == CH_FZ && judged.also.statistic == 0.0);
  // No size below what a right model leaves counts, however sure.
  log.cell[quiet].size = 0.02;
  unknown_judge(&log, nominal, NOMINAL_FLIGHTS, misfit, &judged);
  CHECK(!judged.found);
  log.cell[quiet].size = 0.5;
  // As much as that in one of the nominal flights, and it is chance.
  nominal[3].cell[quiet].statistic = 12.0;
  unknown_judge(&log, nominal, NOMINAL_FLIGHTS, misfit, &judged);
  CHECK(!judged.found);
}

// Of a torque ratio that 60 rows a second do not show, "+0.6 +- 0.6 m/s2" was told at a place.
TEST(gap_tells_nothing_of_a_size_within_two_errors) {
  static const struct {
    cell_t cell;
    bool sure;
  } row[] = {{{.size = 0.603, .error = 0.6, .statistic = 40.0}, false},
             {{.size = -1.19, .error = 0.6, .statistic = 40.0}, false},
             {{.size = -1.21, .error = 0.6, .statistic = 40.0}, true},
             {{.size = 0.6, .statistic = 12.0}, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g +- %g", row[i].cell.size, cell_error(&row[i].cell));
    CHECK(unknown_is_sure(&row[i].cell) == row[i].sure);
  }
}

TEST(gap_judges_what_is_left_again_without_a_cell_that_is_left_out) {
  scan_t log = {.cell = {{.statistic = 0.0}}}, nominal[NOMINAL_FLIGHTS];
  const double misfit[CHANNELS] = {[CH_FZ] = 0.02};
  const int place = unknown_cell(CH_FZ, COORDINATE_HEIGHT, false),
            other = unknown_cell(CH_FX, COORDINATE_VEL_Z, false);
  judged_t judged;
  for (int i = 0; i < NOMINAL_FLIGHTS; i++)
    for (int k = 0; k < UNKNOWN_CELLS; k++) nominal[i].cell[k].statistic = 3.0 + 0.1 * i;
  log.cell[place] = (cell_t){.channel = CH_FZ, .size = 0.5, .statistic = 30.0, .explained = 900.0};
  log.cell[other] = (cell_t){.channel = CH_FX, .size = 0.5, .statistic = 25.0, .explained = 625.0};
  for (int i = 0; i < 3; i++) {
    unknown_judge(&log, nominal, NOMINAL_FLIGHTS, misfit, &judged);
    CHECK(judged.found == (i < 2));
    CHECK(i == 2 || judged.cell.channel == (i ? CH_FX : CH_FZ));
    unknown_leave_out(&log, &judged.cell);
  }
}

// In the nominal flights one look finds ten times what is usual: that bounds chance, and says nothing about
// what a right form with other numbers leaves, 0.02 of what is typical: of that size 0.12 is told, as of
// names. Chance is the root of F(1, 10)'s upper hundredth, 3.17, times 42.
TEST(gap_measures_a_misfit_by_itself_and_not_by_nominal_flights) {
  static const struct {
    double statistic, size;
    int spreads;
    bool found;
  } row[] = {{2000.0, 0.13, 0, true}, {2000.0, 0.11, 0, false},  {150.0, 2.0, 0, true},
             {120.0, 2.0, 0, false},  {2000.0, 0.031, 16, true}, {2000.0, 0.029, 16, false}}; // a line
  scan_t log = {.cell = {{.statistic = 0.0}}}, nominal[NOMINAL_FLIGHTS];
  const double misfit[CHANNELS] = {[CH_WX] = 0.02};
  const int look = unknown_cell(CH_WX, COORDINATE_VEL_Z, false);
  judged_t judged;
  for (int i = 0; i < NOMINAL_FLIGHTS; i++)
    for (int k = 0; k < UNKNOWN_CELLS; k++)
      nominal[i].cell[k].statistic = k == look ? 40.0 + 0.5 * i : 3.0 + 0.1 * i;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("statistic %g, size %g", row[i].statistic, row[i].size);
    log.cell[look] = (cell_t){.channel = CH_WX,
                              .size = row[i].size,
                              .statistic = row[i].statistic,
                              .spreads = row[i].spreads,
                              .explained = row[i].statistic * row[i].statistic};
    unknown_judge(&log, nominal, NOMINAL_FLIGHTS, misfit, &judged);
    CHECK(judged.found == row[i].found);
  }
}

// Ties, and what is told of them: flights that differ before a place, a place before a time before a state,
// whatever explains a little more; what alone would not be told is not in a tie either. Along the body's axes
// and the world's it is one force.
typedef struct {
  int channel, along;
  bool world;
  double explained, size; // of a misfit of 0.02
} lies_t;
static const struct {
  const char *what;
  lies_t lies[3];
  int first, also; // which of them; -1: none
} TIED[] = {
    {"a place", {{CH_FZ, COORDINATE_TIME, false, 400, 9}, {CH_FZ, COORDINATE_HEIGHT, false, 340, 9}}, 1, 0},
    {"less than a tie",
     {{CH_FZ, COORDINATE_TIME, false, 400, 9}, {CH_FZ, COORDINATE_HEIGHT, false, 300, 9}},
     0,
     -1},
    {"a state explains more than the place",
     {{CH_FZ, COORDINATE_TIME, false, 400, 9},
      {CH_FZ, COORDINATE_HEIGHT, false, 331, 9},
      {CH_FZ, COORDINATE_VEL_X, false, 350, 9}},
     1,
     0},
    {"flights that are flown elsewhere differ",
     {{CH_FZ, BY_FLIGHT, false, 340, 9}, {CH_FZ, COORDINATE_HEIGHT, false, 400, 9}},
     0,
     1},
    {"a misfit at a place",
     {{CH_FZ, COORDINATE_TIME, false, 400, 9}, {CH_FZ, COORDINATE_HEIGHT, false, 390, 0.1}},
     0,
     -1},
    {"another channel",
     {{CH_FZ, COORDINATE_TIME, false, 400, 9}, {CH_WX, COORDINATE_HEIGHT, false, 390, 9}},
     0,
     -1},
    {"the world's x is the body's y",
     {{CH_FY, COORDINATE_TIME, false, 400, 9}, {CH_FX, COORDINATE_HEIGHT, true, 390, 9}},
     1,
     0},
    {"the body's x is not its y",
     {{CH_FY, COORDINATE_TIME, false, 400, 9}, {CH_FX, COORDINATE_HEIGHT, false, 390, 9}},
     0,
     -1},
};

TEST(gap_tells_flights_before_a_place_before_a_time_before_a_state) {
  const double misfit[CHANNELS] = {0.02, 0.02, 0.02, 0.02};
  scan_t nominal[NOMINAL_FLIGHTS] = {{.cell = {{.statistic = 0.0}}}};
  for (int i = 0; i < NOMINAL_FLIGHTS; i++)
    for (int k = 0; k < UNKNOWN_CELLS; k++) nominal[i].cell[k].statistic = 3.0;
  for (unsigned i = 0; i < sizeof TIED / sizeof *TIED; i++) {
    ROW("%s", TIED[i].what);
    scan_t log = {.cell = {{.statistic = 0.0}}};
    judged_t judged;
    for (int k = 0; k < 3; k++) {
      const lies_t *const l = &TIED[i].lies[k];
      if (!(l->explained > 0.0)) continue;
      log.cell[unknown_cell(l->channel, l->along, l->world)] = (cell_t){.channel = l->channel,
                                                                        .along = l->along,
                                                                        .world = l->world,
                                                                        .size = l->size,
                                                                        .statistic = sqrt(l->explained),
                                                                        .explained = l->explained};
    }
    unknown_judge(&log, nominal, NOMINAL_FLIGHTS, misfit, &judged);
    const lies_t *const first = &TIED[i].lies[TIED[i].first];
    CHECK(judged.found && judged.cell.along == first->along && judged.cell.world == first->world);
    CHECK((TIED[i].also < 0) == !(judged.also.statistic > 0.0));
    if (TIED[i].also >= 0) CHECK(judged.also.along == TIED[i].lies[TIED[i].also].along);
  }
}

// A bound with a misfit is what is told of a cell.
TEST(gap_tells_the_bound_that_it_holds_a_cell_against) {
  scan_t log = {.cell = {{.statistic = 0.0}}}, nominal[NOMINAL_FLIGHTS] = {{.cell = {{.statistic = 0.0}}}};
  const double misfit[CHANNELS] = {[CH_WX] = 0.02};
  judged_t judged;
  log.cell[unknown_cell(CH_WX, COORDINATE_VEL_Z, false)] = (cell_t){
      .channel = CH_WX, .along = COORDINATE_VEL_Z, .size = 0.1, .statistic = 50.0, .explained = 2500.0};
  unknown_judge(&log, nominal, NOMINAL_FLIGHTS, misfit, &judged);
  CHECK(!judged.found && judged.cell.channel == CH_WX);
  // Ten quiet flights, and noise alone in one: of 552 windows the normal distribution's 4.28.
  CHECK_NEAR(judged.cell_bound, hypot(3.169 * 4.28 / sqrt(11.0), 0.12 / 0.1 * 50.0), 0.01);
}

// A push in a strip that is crossed in less than a second, blurred at its ends as the rows' filter does it,
// in flights of which each has a constant of its own.
TEST(gap_measures_what_lies_in_a_strip_by_the_rows_inside_and_outside) {
  gap_track_t t;
  lines_t l;
  why_t why = {""};
  if (!CHECK_OK(gap_track_make(&t, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  const rows_t *const r = &t.set.smooth;
  cell_t cell = {CH_FZ, COORDINATE_X, "x", "m", 0.05, 0.6, .size = -0.4, .statistic = 100.0};
  splitmix_t noise = {7};
  int inside = 0;
  CHECK_OK(lines_make(&l, &t.set, &why));
  for (int i = 0; i < r->n; i++) {
    double share = 0.0;
    for (int k = i > 0 ? i - 1 : 0; k <= i + 1 && k < r->n; k++) {
      const double x_m = coordinate_of(COORDINATE_X, &t.set.grid[r->flight[k]], &t.vehicle, r->point[k]);
      share += x_m >= cell.from && x_m <= cell.to ? 1.0 / 3.0 : 0.0;
    }
    inside += share > 0.5;
    l.r[CH_FZ][i] = (r->flight[i] ? 3.0 : -2.0) - share + splitmix_normal(&noise, 0.1);
  }
  ROW("%d of %d rows", inside, r->n);
  CHECK(inside > 50 && inside < r->n / 2);
  CHECK_OK(unknown_measure(&t.set, &t.vehicle, l.r, &cell, &why));
  CHECK_NEAR(cell.size, -1.0, 0.06); // what the blur takes
  CHECK(cell.error > 0.003 && cell.error < 0.03);
  cell_t nearly_all = {CH_FZ, COORDINATE_X, "x", "m", -9.0, 0.6, .size = -0.4, .statistic = 100.0};
  CHECK_OK(unknown_measure(&t.set, &t.vehicle, l.r, &nearly_all, &why));
  CHECK(nearly_all.size == -0.4 && nearly_all.error == 0.0); // nearly nothing is outside
  lines_free(&l);
  gap_track_free(&t);
}
