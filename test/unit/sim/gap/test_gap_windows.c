// test_gap_windows.c - what lies at one place or time only, on rows that no flight made: the largest cell,
// and names that stand for it.
#include "gap/5_infer/local.h"
#include "gap/5_infer/timing.h"
#include "exam/flights.h"
#include "gap/5_infer/unknown.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void put(gap_rows_t *g, int channel, int from, int to, double size) {
  for (int i = from; i < to; i++) g->residual[channel][i] += size;
}

// Of all looks, against flights in which none finds anything.
static cell_t largest(gap_rows_t *g) {
  static const scan_t calm[NOMINAL_FLIGHTS];
  scan_t scan;
  judged_t judged;
  why_t why;
  CHECK_OK(unknown_scan(&g->set, &g->model, g->residual, &scan, &why));
  unknown_judge(&scan, calm, NOMINAL_FLIGHTS, (const double[CHANNELS]){0.0}, &judged);
  return judged.cell;
}

TEST(gap_finds_the_window_in_which_something_lies) {
  static const struct {
    const char *what;
    int channel, from, to; // rows: of a height from 0 to 1 m
    double size, constant;
  } row[] = {{"a layer", CH_FZ, 400, 600, 1.0, 0.0},
             {"a thin one", CH_FX, 800, 900, -1.5, 0.0},
             {"the lowest, turning", CH_WY, 0, 300, 1.0, 0.0},
             {"the lowest, more of what is everywhere", CH_FZ, 0, 300, 1.0, 3.0},
             {"all but the lowest", CH_FZ, 300, GAP_ROWS, 1.0, 0.0}, // was told as -1 in the lowest
             {"all but the highest", CH_FX, 0, 900, -1.0, 0.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    why_t why;
    cell_t cell;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 31);
    cell = largest(&g);
    CHECK(cell.statistic > 1.0 && cell.statistic < 4.5); // the largest of a thousand windows of noise
    put(&g, row[i].channel, row[i].from, row[i].to, row[i].size);
    put(&g, row[i].channel, 0, GAP_ROWS, row[i].constant);
    cell = largest(&g);
    CHECK(cell.channel == row[i].channel && cell.statistic > 8.0);
    CHECK(strcmp(cell.coordinate, "height") == 0 || strcmp(cell.coordinate, "time") == 0);
    const double unit = strcmp(cell.coordinate, "height") == 0 ? 1.0 : 0.04 * GAP_ROWS;
    CHECK_NEAR(cell.from / unit, (double)row[i].from / GAP_ROWS, 0.09); // a bin holds a twelfth
    CHECK_NEAR(cell.to / unit, (double)row[i].to / GAP_ROWS, 0.09);
    CHECK(cell.size * row[i].size > 0.0 && fabs(cell.size) > 0.5 * fabs(row[i].size));
    CHECK_OK(unknown_clean(&g.set, &g.model, g.residual, &why));
    cell = largest(&g);
    CHECK(cell.statistic < 8.0);
    gap_rows_free(&g);
  }
}

// A push along the world's y in a layer, on a vehicle that turns round once in it: in its own axes the push
// goes round, too.
TEST(gap_finds_a_layer_whose_push_stays_while_the_vehicle_turns) {
  gap_rows_t g;
  why_t why;
  cell_t cell;
  gap_rows_make(&g, 33);
  g.grid.has_attitude = true;
  for (int i = 0; i < GAP_ROWS; i++) {
    const double heading = 2.0 * PI * i / 200.0, push = i >= 400 && i < 600 ? 1.0 : 0.0;
    g.grid.point[i].q_wb = (dq_t){cos(0.5 * heading), 0.0, 0.0, sin(0.5 * heading)};
    g.residual[CH_FX][i] += push * sin(heading);
    g.residual[CH_FY][i] += push * cos(heading);
  }
  cell = largest(&g);
  CHECK(cell.world && cell.channel == CH_FY && cell.statistic > 8.0);
  CHECK_NEAR(cell.size, 1.0, 0.3);
  CHECK_OK(unknown_clean(&g.set, &g.model, g.residual, &why));
  cell = largest(&g);
  CHECK(cell.statistic < 8.0);
  gap_rows_free(&g);
}

// A corner of the floor; three pulses; a line. Each is found by the look that is made for it, and noise alone
// by none.
typedef enum { A_CORNER, PULSES, A_SHAKE } lie_t;

static double lies(lie_t what, const grid_point_t *p) {
  switch (what) {
  case A_CORNER: return p->pos_w_m.x > 0.2 && p->pos_w_m.y > 0.2 ? -1.5 : 0.0;
  case PULSES: return fmod(p->t_s, 13.0) > 12.5 ? 2.5 : 0.0;
  case A_SHAKE: return sin(2.0 * PI * 2.5 * p->t_s);
  }
  return 0.0;
}

TEST(gap_finds_a_corner_a_pulse_and_a_shake) {
  static const struct {
    const char *what;
    lie_t lie;
    const char *coordinate;
    double from, to, within; // bounds of the cell, at most so far off
    double size;
  } row[] = {{"a corner", A_CORNER, "x", 0.2, 1.0, 0.02, -1.5},
             {"pulses", PULSES, "time", 12.5, 13.0, 0.2, 2.5},
             {"a shake", A_SHAKE, "frequency", 2.4, 2.6, 0.1, 1.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 34);
    for (int k = 0; k < GAP_ROWS; k++) {
      grid_point_t *const p = &g.grid.point[k];
      p->pos_w_m = d3(sin(0.37 * k), cos(0.23 * k), 0.5);
      g.residual[CH_FY][k] += lies(row[i].lie, p);
    }
    const cell_t cell = largest(&g);
    CHECK(cell.channel == CH_FY && cell.statistic > 6.5);
    CHECK(strcmp(cell.coordinate, row[i].coordinate) == 0);
    const double over = row[i].lie == PULSES ? 13.0 * floor(cell.from / 13.0) : 0.0;
    CHECK_NEAR(cell.from - over, row[i].from, row[i].within);
    CHECK_NEAR(cell.to - over, row[i].to, row[i].within);
    CHECK_NEAR(cell.size / row[i].size, 1.0, 0.5);
    CHECK((cell.spreads > 1) == (row[i].lie == A_SHAKE)); // a misfit is wider than a line
    if (row[i].lie == A_CORNER)
      CHECK(cell.is_patch && fabs(cell.y_from_m - 0.2) < 0.02 && fabs(cell.y_to_m - 1.0) < 0.02);
    gap_rows_free(&g);
  }
}

// An edge's place among all rows, in sixteenths of the floor's eight strips.
static double among_rows(const gap_rows_t *g, bool is_y, double edge) {
  int below = 0;
  for (int k = 0; k < GAP_ROWS; k++) {
    const d3_t at = g->grid.point[k].pos_w_m;
    below += (is_y ? at.y : at.x) < edge;
  }
  return 128.0 * below / GAP_ROWS;
}

// A few rows at one spot are no place, however large: a hover shows hundreds of spots.
TEST(gap_patch_of_the_floor_is_no_narrower_than_a_strip) {
  gap_rows_t g;
  scan_t scan;
  why_t why;
  int inside_x = 0, inside_y = 0;
  gap_rows_make(&g, 35);
  for (int k = 0; k < GAP_ROWS; k++) {
    grid_point_t *const p = &g.grid.point[k];
    p->pos_w_m = d3(sin(0.37 * k), cos(0.23 * k), 0.5);
    if (fabs(p->pos_w_m.x - 0.5) < 0.01) g.residual[CH_FY][k] += 6.0;
  }
  CHECK_OK(unknown_scan(&g.set, &g.model, g.residual, &scan, &why));
  const cell_t *const c = &scan.cell[unknown_cell(CH_FY, LOOK_FLOOR, false)];
  CHECK(c->is_patch && c->statistic > 0.0);
  for (int k = 0; k < GAP_ROWS; k++) {
    const d3_t at = g.grid.point[k].pos_w_m;
    inside_x += at.x >= c->from && at.x <= c->to;
    inside_y += at.y >= c->y_from_m && at.y <= c->y_to_m;
  }
  CHECK(inside_x >= GAP_ROWS / 8 - 1 && inside_y >= GAP_ROWS / 8 - 1);
  const double edge[] = {among_rows(&g, false, c->from), among_rows(&g, false, c->to),
                         among_rows(&g, true, c->y_from_m), among_rows(&g, true, c->y_to_m)};
  for (int k = 0; k < 4; k++) CHECK_NEAR(edge[k], round(edge[k]), 0.13); // a row is 0.11
  gap_rows_free(&g);
}

// A constant is no window; it is one where nothing is taken for known.
TEST(gap_takes_a_constant_for_no_window) {
  gap_rows_t g;
  why_t why;
  cell_t centred[CHANNELS], whole[CHANNELS];
  color_t color[CHANNELS];
  gap_rows_make(&g, 32);
  CHECK_OK(unknown_colors(&g.set, &g.model, g.residual, color, &why));
  put(&g, CH_FY, 0, GAP_ROWS, 1.0);
  CHECK_OK(unknown_along(&g.set, &g.model, 0, COORDINATES, g.residual, color, true, centred, &why));
  CHECK_OK(unknown_along(&g.set, &g.model, 0, COORDINATES, g.residual, color, false, whole, &why));
  for (int ch = 0; ch < CHANNELS; ch++) {
    CHECK(centred[ch].statistic < 4.5);
    CHECK(ch == CH_FY ? whole[ch].statistic > 15.0 : whole[ch].statistic < 15.0);
  }
  gap_rows_free(&g);
}

TEST(gap_bins_hold_equally_many_rows_each) {
  gap_rows_t g;
  int bin[GAP_ROWS], count[WINDOW_BINS] = {0};
  double room[2 * GAP_ROWS];
  gap_rows_make(&g, 33);
  CHECK(windows_bins(&g.set, &g.model, COORDINATE_HEIGHT, 0, room, bin));
  for (int i = 0; i < GAP_ROWS; i++) count[bin[i]]++;
  for (int k = 0; k < WINDOW_BINS; k++) CHECK_NEAR(count[k], 100, 2);      // of 1200
  CHECK(!windows_bins(&g.set, &g.model, COORDINATE_Y, 0, room, bin));      // it does not move
  CHECK(!windows_bins(&g.set, &g.model, COORDINATE_HEIGHT, 1, room, bin)); // no row
  gap_rows_free(&g);
}

// A name along a column that is there everywhere, and what truly acts.
static int drag(gap_rows_t *g) {
  const int i = gap_rows_candidate(g, "rotor_drag");
  double *const x = gap_rows_column(g, i, 0, CH_FX);
  for (int k = 0; k < GAP_ROWS; k++) x[k] = sin(0.11 * k) + 0.4;
  return i;
}

// Of n rows that a name explains by half, because it acts in half of them: the same there alone takes a
// quarter of their squares more, and by chance one of so many parts takes 40.
TEST(gap_knows_a_name_that_acts_in_one_part_only) {
  static const struct {
    const char *what;
    int from, to;        // rows
    double size, beside; // what acts there, and elsewhere
    double push;         // there, that is no effect of it
    bool confined;
  } row[] = {{"everywhere", 0, 600, 1.0, 1.0, 0.0, false},
             {"a push at one place", 500, 700, 0.0, 0.0, 2.0, true},
             {"in one half", 0, 600, 2.0, 0.0, 0.0, true},
             {"in one half, weakly", 0, 600, 0.6, 0.0, 0.0, true},
             {"more weakly than chance", 0, 600, 0.36, 0.0, 0.0, false},
             {"less in one half", 0, 600, 1.0, 0.7, 0.0, false},
             {"in the middle", 300, 900, 1.0, 0.0, 0.0, true},
             {"but in the middle", 300, 900, 0.0, 1.0, 0.0, true},
             {"but in a twentieth", 600, 660, 0.0, 1.5, 0.0, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    why_t why;
    bool confined;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 35);
    const int of = drag(&g);
    const double *const x = gap_rows_column(&g, of, 0, CH_FX);
    for (int k = 0; k < GAP_ROWS; k++)
      g.residual[CH_FX][k] +=
          k >= row[i].from && k < row[i].to ? row[i].size * x[k] + row[i].push : row[i].beside * x[k];
    gap_rows_open(&g, 1, &of);
    CHECK_OK(local_is_confined(&g.round, of, &confined, &why));
    CHECK(confined == row[i].confined);
    gap_rows_free(&g);
  }
}

// A name that acts in the first quarter only, and gives 1.5 or so of each of its rows, where something else
// begins and ends in this or another channel: constants say as much, and of its own channel it counts.
TEST(gap_asks_what_began_in_the_channels_of_a_name_alone) {
  static const struct {
    const char *what;
    double steady; // part of the column
    int channel;
    bool confined;
  } row[] = {{"it swings, and a push along z begins and ends", 0.0, CH_FZ, false},
             {"it swings, and nothing else is there", 0.0, -1, false},
             {"it is steady itself", 1.0, -1, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    why_t why;
    bool confined;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 37);
    const int of = gap_rows_candidate(&g, "rotor_drag");
    double *const x = gap_rows_column(&g, of, 0, CH_FX);
    for (int k = 0; k < GAP_ROWS / 4; k++) {
      x[k] = row[i].steady > 0.0 ? 1.2 : 1.7 * sin(0.11 * k);
      g.residual[CH_FX][k] += x[k];
      if (row[i].channel >= 0) g.residual[row[i].channel][k] += 3.0;
    }
    gap_rows_open(&g, 1, &of);
    CHECK_OK(local_is_confined(&g.round, of, &confined, &why));
    CHECK(confined == row[i].confined);
    gap_rows_free(&g);
  }
}

TEST(gap_knows_which_names_are_alike) {
  gap_rows_t g;
  why_t why;
  bool alike[5];
  gap_rows_make(&g, 36);
  const int of = drag(&g), twin = gap_rows_candidate(&g, "flapping"),
            other = gap_rows_candidate(&g, "climb_inflow"), most = gap_rows_candidate(&g, "body_drag"),
            little = gap_rows_candidate(&g, "translational_lift");
  memcpy(gap_rows_column(&g, twin, 0, CH_FX), gap_rows_column(&g, of, 0, CH_FX), GAP_ROWS * sizeof(double));
  gap_rows_white(&g, gap_rows_column(&g, other, 0, CH_FX));
  // x and what is apart from it: of x these give 0.66 / (0.66 + 0.36) and 0.66 / (0.66 + 1.2).
  for (int k = 0; k < GAP_ROWS; k++) {
    const double x = gap_rows_column(&g, of, 0, CH_FX)[k], apart = k % 2 ? 1.0 : -1.0;
    gap_rows_column(&g, most, 0, CH_FX)[k] = x + sqrt(0.36) * apart;
    gap_rows_column(&g, little, 0, CH_FX)[k] = x + sqrt(1.2) * apart;
  }
  gap_rows_add(&g, of, 0, 1.0);
  gap_rows_open(&g, 1, &of);
  CHECK_OK(local_alike(&g.round, of, alike, &why));
  CHECK(alike[of] && alike[twin] && alike[most] && !alike[little] && !alike[other]);
  gap_rows_free(&g);
}

// --- lags and delays that no straight line finds -----------------------------------------------------------

TEST(gap_finds_a_long_delay_by_trying_and_no_delay_where_there_is_none) {
  static const struct {
    const char *hidden;
    double s;
  } row[] = {{NULL, 0.0}, {"delay", 0.01}, {"motor_lag", 0.04}, {"motor_lag", 0.058}, {"motor_lag", 0.08}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    model_t base, truth;
    why_t why = {""};
    gap_flight_t flight;
    candidates_t c;
    timing_t found;
    set_t set = {.n_grid = 0};
    grid_t *const grid = calloc(2, sizeof *grid);
    ROW("%s", row[i].hidden ? row[i].hidden : "nothing");
    CHECK_OK(exam_vehicle(&base, &why));
    truth = base;
    if (row[i].hidden) {
      fx_use_t use = fx_use(fx_find(row[i].hidden));
      fx_use_resize(&use, 0, row[i].s);
      CHECK_OK(model_add_fx(&truth, &use, &why));
    }
    const exam_flight_t job = {.truth = &truth, .seed = 22200};
    if (!grid || !CHECK_OK(exam_fly(&job, &flight, &why))) return;
    CHECK_OK(grid_make(&grid[0], &flight, 0, flight.n, &base, &why));
    CHECK_OK(set_make(&set, grid, 1, &why));
    CHECK_OK(candidates_make(&c, &base, &set, &why));
    CHECK_OK(timing_find(&found, &c, &set, &base, &why));
    // Up to 45 ms a straight line finds it: it is left to that.
    CHECK((found.candidate >= 0) == (row[i].s > 0.045) && !found.measured);
    if (found.candidate >= 0) {
      CHECK_TEXT(c.candidate[found.candidate].use.fx->name, row[i].hidden);
      CHECK_NEAR(found.value_s, row[i].s, 0.13 * row[i].s); // half of a third of an octave
    }
    candidates_free(&c);
    set_free(&set);
    gap_flight_free(&flight);
  }
}
