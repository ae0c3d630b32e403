// test_gap_windows.c - what lies at one place or time only, on rows that no flight made: the largest cell,
// and names that are an echo of it.
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

TEST(gap_finds_the_window_in_which_something_lies) {
  static const struct {
    const char *what;
    int channel, from, to; // rows: of a height from 0 to 1 m
    double size;
  } row[] = {{"a layer", CH_FZ, 400, 600, 1.0},
             {"a thin one", CH_FX, 800, 900, -1.5},
             {"the lowest, turning", CH_WY, 0, 300, 1.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    why_t why;
    cell_t cell;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 31);
    CHECK_OK(unknown_largest(&g.set, &g.model, g.residual, NULL, true, &cell, &why));
    CHECK(cell.statistic > 1.0 && cell.statistic < 4.5); // the largest of a thousand windows of noise
    put(&g, row[i].channel, row[i].from, row[i].to, row[i].size);
    CHECK_OK(unknown_largest(&g.set, &g.model, g.residual, NULL, true, &cell, &why));
    CHECK(cell.channel == row[i].channel && cell.statistic > 8.0);
    CHECK(strcmp(cell.coordinate, "height") == 0 || strcmp(cell.coordinate, "time") == 0);
    const double unit = strcmp(cell.coordinate, "height") == 0 ? 1.0 : 0.04 * GAP_ROWS;
    CHECK_NEAR(cell.from / unit, (double)row[i].from / GAP_ROWS, 0.09); // a bin holds a twelfth
    CHECK_NEAR(cell.to / unit, (double)row[i].to / GAP_ROWS, 0.09);
    CHECK(cell.size * row[i].size > 0.0 && fabs(cell.size) > 0.5 * fabs(row[i].size));
    CHECK_OK(unknown_clean(&g.set, &g.model, g.residual, &why));
    CHECK_OK(unknown_largest(&g.set, &g.model, g.residual, NULL, true, &cell, &why));
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
  CHECK_OK(unknown_largest(&g.set, &g.model, g.residual, NULL, true, &cell, &why));
  CHECK(cell.world && cell.channel == CH_FY && cell.statistic > 8.0);
  CHECK_NEAR(cell.size, 1.0, 0.3);
  CHECK_OK(unknown_clean(&g.set, &g.model, g.residual, &why));
  CHECK_OK(unknown_largest(&g.set, &g.model, g.residual, NULL, true, &cell, &why));
  CHECK(cell.statistic < 8.0);
  gap_rows_free(&g);
}

// A constant is no window; it is one where nothing is taken for known.
TEST(gap_takes_a_constant_for_no_window) {
  gap_rows_t g;
  why_t why;
  cell_t centred, whole;
  color_t color[CHANNELS];
  gap_rows_make(&g, 32);
  CHECK_OK(unknown_colors(&g.set, &g.model, g.residual, color, &why));
  put(&g, CH_FY, 0, GAP_ROWS, 1.0);
  CHECK_OK(unknown_largest(&g.set, &g.model, g.residual, color, true, &centred, &why));
  CHECK_OK(unknown_largest(&g.set, &g.model, g.residual, color, false, &whole, &why));
  CHECK(centred.statistic < 4.5);
  CHECK(whole.channel == CH_FY && whole.statistic > 15.0);
  gap_rows_free(&g);
}

TEST(gap_bins_hold_equally_many_rows_each) {
  gap_rows_t g;
  int bin[GAP_ROWS], count[UNKNOWN_BINS] = {0}, height = -1, still = -1;
  double room[2 * GAP_ROWS];
  gap_rows_make(&g, 33);
  for (int i = 0; i < coordinate_count; i++) {
    if (strcmp(coordinate_name(i), "height") == 0) height = i;
    if (strcmp(coordinate_name(i), "y") == 0) still = i;
  }
  CHECK(unknown_bins(&g.set, &g.model, height, 0, room, bin));
  for (int i = 0; i < GAP_ROWS; i++) count[bin[i]]++;
  for (int k = 0; k < UNKNOWN_BINS; k++) CHECK_NEAR(count[k], GAP_ROWS / UNKNOWN_BINS, 2);
  CHECK(!unknown_bins(&g.set, &g.model, still, 0, room, bin));  // it does not move
  CHECK(!unknown_bins(&g.set, &g.model, height, 1, room, bin)); // no row
  gap_rows_free(&g);
}

// A name along a column that is there everywhere, and what truly acts.
static int drag(gap_rows_t *g) {
  const int i = gap_rows_candidate(g, "rotor_drag");
  double *const x = gap_rows_column(g, i, 0, CH_FX);
  for (int k = 0; k < GAP_ROWS; k++) x[k] = sin(0.11 * k) + 0.4;
  return i;
}

TEST(gap_knows_a_name_that_is_an_echo_of_something_at_one_place) {
  for (int place = 0; place < 2; place++) {
    gap_rows_t g;
    why_t why;
    bool echo, confined;
    ROW("%s", place ? "a place" : "the name itself");
    gap_rows_make(&g, 34);
    const int of = drag(&g);
    if (place)
      put(&g, CH_FX, 500, 700, 2.0);
    else
      gap_rows_add(&g, of, 0, 1.0);
    gap_rows_open(&g, 1, &of);
    CHECK_OK(local_is_echo(&g.round, of, &echo, &why));
    CHECK_OK(local_is_confined(&g.round, of, &confined, &why));
    CHECK(echo == (bool)place);
    if (!place) CHECK(!confined);
    gap_rows_free(&g);
  }
}

TEST(gap_knows_a_name_that_acts_in_one_part_only) {
  gap_rows_t g;
  why_t why;
  bool confined;
  gap_rows_make(&g, 35);
  const int of = drag(&g);
  const double *const x = gap_rows_column(&g, of, 0, CH_FX);
  for (int i = 0; i < GAP_ROWS / 2; i++) g.residual[CH_FX][i] += 2.0 * x[i];
  gap_rows_open(&g, 1, &of);
  CHECK_OK(local_is_confined(&g.round, of, &confined, &why));
  CHECK(confined);
  gap_rows_free(&g);
}

TEST(gap_knows_which_names_are_alike) {
  gap_rows_t g;
  why_t why;
  bool alike[3];
  gap_rows_make(&g, 36);
  const int of = drag(&g), twin = gap_rows_candidate(&g, "flapping"),
            other = gap_rows_candidate(&g, "climb_inflow");
  memcpy(gap_rows_column(&g, twin, 0, CH_FX), gap_rows_column(&g, of, 0, CH_FX), GAP_ROWS * sizeof(double));
  gap_rows_white(&g, gap_rows_column(&g, other, 0, CH_FX));
  gap_rows_add(&g, of, 0, 1.0);
  gap_rows_open(&g, 1, &of);
  CHECK_OK(local_alike(&g.round, of, alike, &why));
  CHECK(alike[of] && alike[twin] && !alike[other]);
  gap_rows_free(&g);
}

// --- lags and delays that no straight line finds -----------------------------------------------------------

TEST(gap_finds_a_long_delay_by_trying_and_no_delay_where_there_is_none) {
  static const struct {
    const char *hidden;
    double s;
  } row[] = {{NULL, 0.0}, {"delay", 0.01}, {"motor_lag", 0.08}};
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
      CHECK_NEAR(found.value_s, row[i].s, 0.016);
    }
    candidates_free(&c);
    set_free(&set);
    gap_flight_free(&flight);
  }
}
