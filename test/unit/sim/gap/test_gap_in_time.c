// test_gap_in_time.c - pulses and lines on rows that no flight made.
#include "gap/5_infer/in_time.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <math.h>

#include <stdlib.h>
#include <string.h>

#define ROW_S 0.04
#define CALM  0.05 // of the rows' standard deviation: the noise of what is not added here

// The largest pulse or line in a channel, of rows without colour.
static cell_t look_at(gap_rows_t *g, int channel, void (*in_time)(const look_t *, cell_t[LOOKED])) {
  color_t color[CHANNELS] = {{.used = false}};
  color[channel] = (color_t){.used = true, .sd = 1.0};
  cell_t cell[LOOKED] = {{.statistic = 0.0}};
  look_t l = look_of(&g->set, &g->model, g->residual, color, true);
  l.room = malloc(LOOK_ROOM * set_most_rows(&g->set) * sizeof(double));
  if (CHECK(l.room)) in_time(&l, cell);
  free(l.room);
  return cell[channel];
}

static cell_t look(gap_rows_t *g, void (*in_time)(const look_t *, cell_t[LOOKED])) {
  return look_at(g, CH_FZ, in_time);
}

static void make_calm(gap_rows_t *g, unsigned long seed) {
  gap_rows_make(g, seed);
  for (int i = 0; i < GAP_ROWS; i++) g->residual[CH_FZ][i] *= CALM;
}

static void put(gap_rows_t *g, int from, int rows, double size) {
  for (int i = from; i < from + rows; i++) g->residual[CH_FZ][i] += size;
}

// Of 2 to 16 rows. One row alone is not told as such: the rows are filtered. What is longer is told in part,
// and lies in a window of time.
TEST(gap_finds_a_pulse_of_any_length_up_to_two_thirds_of_a_second) {
  static const struct {
    int rows, told;
    double size;
  } row[] = {{1, 2, 0.5}, {2, 2, 1.0}, {4, 4, 1.0}, {8, 8, 1.0}, {16, 16, 1.0}, {40, 16, 1.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    ROW("%d rows", row[i].rows);
    make_calm(&g, 41);
    put(&g, 400, row[i].rows, 1.0);
    const cell_t cell = look(&g, in_time_pulses);
    CHECK_NEAR((cell.to - cell.from) / ROW_S + 1.0, row[i].told, 0.1);
    CHECK(cell.from / ROW_S > 398.5 && cell.to / ROW_S < 400.5 + row[i].rows);
    CHECK_NEAR(cell.size, row[i].size, 0.1);
    gap_rows_free(&g);
  }
}

// What begins with a flight, or with the rows after a gap, is the start of estimator and pilot.
TEST(gap_finds_no_pulse_in_the_first_second) {
  static const struct {
    int gap, from; // the rows break off before `gap`
    bool found;
  } row[] = {{0, 21, false}, {0, 28, true}, {600, 621, false}, {600, 628, true}, {600, 590, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    ROW("gap at %d, pulse at %d", row[i].gap, row[i].from);
    make_calm(&g, 42);
    if (row[i].gap) g.set.smooth.follows[row[i].gap] = false;
    put(&g, row[i].from, 2, 2.0);
    const cell_t cell = look(&g, in_time_pulses);
    CHECK((cell.statistic > 10.0) == row[i].found);
    if (row[i].found) CHECK_NEAR(cell.from / ROW_S, row[i].from, 0.1);
    gap_rows_free(&g);
  }
}

// One flight of three weighs more: what it has all the time is no train of pulses, and hides none.
TEST(gap_finds_no_pulse_in_what_a_flight_has_all_the_time) {
  enum { FLIGHTS = 3, EACH = GAP_ROWS / FLIGHTS };
  for (int pulses = 0; pulses < 2; pulses++) {
    gap_rows_t g;
    make_calm(&g, 43);
    grid_t grid[FLIGHTS];
    for (int f = 0; f < FLIGHTS; f++) grid[f] = g.grid;
    g.set.grid = grid, g.set.n_grid = FLIGHTS;
    for (int i = 0; i < GAP_ROWS; i++) {
      g.set.smooth.flight[i] = i / EACH < FLIGHTS ? i / EACH : FLIGHTS - 1;
      if (i % EACH == 0) g.set.smooth.follows[i] = false;
    }
    put(&g, EACH, EACH, 2.0);
    if (pulses) put(&g, EACH + 200, 8, 1.0);
    const cell_t cell = look(&g, in_time_pulses);
    CHECK((cell.statistic > 10.0) == (pulses > 0));
    if (pulses) CHECK_NEAR(cell.from / ROW_S, EACH + 200, 0.1);
    gap_rows_free(&g);
  }
}

// Of two motors, every 200 rows; the others' stand still.
static void command_steps(gap_rows_t *g) {
  static double still_N[GAP_ROWS], steps_N[GAP_ROWS];
  for (int k = 0; k < GAP_ROWS; k++) steps_N[k] = 0.01 * (k / 200 % 2);
  for (int k = 0; k < ROTORS; k++) g->grid.command_N[k] = k >= 2 ? steps_N : still_N;
  g->grid.command_Hz = 500.0;
  g->grid.samples = GAP_ROWS;
}

// Three pulses, and commands that step every 200 rows. Of a log that misses commands a pulse at a step is one
// of those, in what commands make: lift and turning. One that comes while commands stand still is not.
TEST(gap_finds_no_pulse_where_commands_change_that_a_log_misses) {
  static const struct {
    const char *what;
    double rate_Hz; // of the log; commands come 500 times a second
    bool means;
    int later; // rows behind the steps
    int channel;
    bool found;
    double tau_s; // of the motors, which do what they were told so much later
  } row[] = {{"no command is missed", 500.0, false, 0, CH_WX, true, 0.0},
             {"some are", 100.0, false, 0, CH_WX, false, 0.0},
             {"rows are means", 100.0, true, 0, CH_WX, true, 0.0},
             {"some are, while others stand", 100.0, false, 60, CH_WX, true, 0.0},
             {"no command is missed, lift", 500.0, false, 0, CH_FZ, true, 0.0},
             {"some are, lift", 100.0, false, 0, CH_FZ, false, 0.0},
             {"some are, while others stand, lift", 100.0, false, 60, CH_FZ, true, 0.0},
             {"some are, a push from the side", 100.0, false, 0, CH_FX, true, 0.0},
             {"some are, a little earlier", 100.0, false, 6, CH_FZ, true, 0.0},
             {"some are, a little earlier, by motors that lag", 100.0, false, 6, CH_FZ, false, 0.1}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    ROW("%s", row[i].what);
    gap_rows_make(&g, 44);
    g.flight.rate_Hz = row[i].rate_Hz;
    g.flight.rows_are_means = row[i].means;
    g.model.motor_tau_s = row[i].tau_s;
    command_steps(&g);
    for (int k = 0; k < GAP_ROWS; k++) g.residual[row[i].channel][k] *= CALM;
    for (int k = 400; k < 1000; k += 200)
      for (int q = 0; q < 2; q++) g.residual[row[i].channel][k + row[i].later + q] += 1.0;
    const cell_t cell = look_at(&g, row[i].channel, in_time_pulses);
    CHECK((cell.statistic > 8.0) == row[i].found);
    for (int k = 0; k < ROTORS; k++) g.grid.command_N[k] = NULL;
    gap_rows_free(&g);
  }
}

// Lines from one number to another, a sixteenth of a hertz each, all as strong.
static void hum(gap_rows_t *g, int from, int to) {
  for (int k = from; k <= to; k++)
    for (int i = 0; i < GAP_ROWS; i++)
      g->residual[CH_FZ][i] += 0.2 * sin(2.0 * PI * k / 16.0 * ROW_S * i + 1.7 * k * k);
}

// Slower than 1 Hz is how the vehicle flies about; faster than 8 Hz the rows do not hold. A narrow hum is a
// line beside what is quiet to either side, a wide one is the colour of the noise.
TEST(gap_finds_a_line_where_it_is_narrow_and_faster_than_the_flight) {
  static const struct {
    const char *what;
    int from, to;
    bool found;
  } row[] = {{"nothing", 1, 0, false},    {"0.87 Hz", 14, 14, false}, {"1.06 Hz", 17, 17, true},
             {"2.5 Hz", 40, 40, true},    {"7.8 Hz", 125, 125, true}, {"2.2 to 2.8 Hz", 35, 45, true},
             {"2 to 3 Hz", 32, 48, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    ROW("%s", row[i].what);
    make_calm(&g, 43);
    hum(&g, row[i].from, row[i].to);
    const cell_t cell = look(&g, in_time_lines);
    CHECK((cell.statistic > 6.0) == row[i].found);
    if (row[i].found) CHECK(cell.from >= (row[i].from - 1.5) / 16.0 && cell.to <= (row[i].to + 1.5) / 16.0);
    if (row[i].found && row[i].from == row[i].to) CHECK_NEAR(cell.size, 0.2, 0.03);
    if (row[i].found) CHECK_NEAR(cell.to - cell.from, 2.0 / 16.0, 1e-9);
    gap_rows_free(&g);
  }
}
