// test_gap_read.c - stage 1 of the workflow: what a log becomes, and what it is refused for.
#include "gap/1_read/flight.h"
#include "rig/flight_csv.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static done_t read_by(const columns_t *columns, gap_flight_t *f, const flight_csv_t *made, why_t *why) {
  model_t vehicle;
  TRY(model_builtin("cf21_legacy", &vehicle, why));
  return gap_read(f, flight_csv_file(made, "f.csv"), columns, &vehicle, why);
}

static done_t read_made(gap_flight_t *f, const flight_csv_t *made, why_t *why) {
  const columns_t columns = flight_csv_columns();
  return read_by(&columns, f, made, why);
}

static const struct {
  signal_id_t signal;
  int column;
  double si;
} TRUTH[] = {{SIG_X, FC_X, 1.0},   {SIG_Z, FC_Z, 1.0},
             {SIG_VZ, FC_VZ, 1.0}, {SIG_AZ, FC_AZ, 9.81},
             {SIG_QX, FC_QX, 1.0}, {SIG_GY, FC_GY, 3.14159265358979323846 / 180.0},
             {SIG_M2, FC_M2, 1.0}, {SIG_W3, FC_W3, 0.1047198}};

// The largest error of a signal, as a share of its range.
static double worst(const gap_flight_t *f, int truth, double from_s) {
  double error = 0.0, min = HUGE_VAL, max = -HUGE_VAL;
  for (int i = 5; i < f->n - 5; i++) {
    double v[FC_COLUMNS];
    flight_csv_values(f->t_s[i], v);
    const double want = TRUTH[truth].si * v[TRUTH[truth].column];
    min = fmin(min, want);
    max = fmax(max, want);
    if (f->t_s[i] >= from_s) error = fmax(error, fabs(f->v[TRUTH[truth].signal][i] - want));
  }
  return error / (max - min);
}

TEST(gap_reads_every_rate_to_a_uniform_time_base) {
  static const struct {
    const char *what;
    double dt_ms, rate_Hz, tol; // tol: of the range of a signal
    int rows;
  } row[] = {{"50 Hz", 20.0, 50.0, 0.02, 1000},
             {"100 Hz", 10.0, 100.0, 0.01, 2000},
             {"101.2 Hz", 9.88, 101.2146, 0.01, 2000},
             {"507 Hz", 1.972, 500.0, 0.01, 8000},
             {"1 kHz", 1.0, 500.0, 0.01, 16000}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gap_flight_t f;
    why_t why = {""};
    CHECK_OK(read_made(&f, &(flight_csv_t){.dt_ms = row[i].dt_ms, .rows = row[i].rows}, &why));
    CHECK_TEXT(why.text, "");
    CHECK_NEAR(f.rate_Hz, row[i].rate_Hz, 1e-3 * row[i].rate_Hz);
    CHECK(f.rows == row[i].rows && f.n > 0.95 * row[i].rate_Hz * 1e-3 * row[i].dt_ms * row[i].rows);
    for (int k = 1; k < f.n; k++)
      if (!CHECK_NEAR(f.t_s[k] - f.t_s[k - 1], 1.0 / f.rate_Hz, 1e-9)) break;
    for (int k = 0; k < (int)(sizeof TRUTH / sizeof *TRUTH); k++)
      if (f.n > 0) CHECK_NEAR(worst(&f, k, 0.0), 0.0, row[i].tol);
    gap_flight_free(&f);
  }
}

TEST(gap_aligns_streams_that_are_late) {
  static const struct {
    const char *what;
    double dt_ms, att_s, vel_s, place_s, tol_s;
    bool unsaid; // of the position
  } row[] = {{"together", 2.0, 0.0, 0.0, 0.0, 1e-9, false},
             {"together, 100 Hz", 10.0, 0.0, 0.0, 0.0, 1e-9, false},
             {"attitude", 2.0, 0.005, 0.0, 0.0, 0.0003, false},
             {"velocity and position", 2.0, 0.0, 0.008, 0.0, 0.0005, false},
             {"velocity alone", 2.0, 0.0, 0.016, -0.016, 0.0005, false},
             {"position alone: or is it the velocity?", 2.0, 0.0, 0.0, -0.008, 1e-9, true},
             {"position later still", 2.0, 0.0, 0.008, 0.002, 0.0005, true},
             {"velocity and position early, attitude late, 100 Hz", 10.0, 0.004, -0.006, 0.0, 0.001, false},
             {"all, 100 Hz", 10.0, 0.004, 0.006, -0.002, 0.001, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const flight_csv_t made = {.dt_ms = row[i].dt_ms,
                               .rows = (int)(20000.0 / row[i].dt_ms),
                               .late_att_s = row[i].att_s,
                               .late_vel_s = row[i].vel_s,
                               .late_place_s = row[i].place_s};
    gap_flight_t f;
    why_t why = {""};
    CHECK_OK(read_made(&f, &made, &why));
    CHECK_TEXT(why.text, "");
    CHECK_NEAR(f.attitude_late_s, row[i].att_s, row[i].tol_s);
    CHECK_NEAR(f.velocity_late_s, row[i].vel_s, row[i].tol_s);
    CHECK_NEAR(f.position_late_s, row[i].unsaid ? 0.0 : row[i].place_s, row[i].tol_s);
    for (int k = row[i].unsaid ? 2 : 0; k < 5 && f.n > 0; k++) CHECK_NEAR(worst(&f, k, 0.0), 0.0, 0.012);
    gap_flight_free(&f);
  }
}

// Rows 51, 52, 54 of the faults.
static const struct {
  const char *what;
  flight_csv_t made;
  const char *want; // null: read
  long bad, missing;
  int segments;
  const char *note; // one of them has this
} spoilt[] = {
    {"nothing", {.scale = 1.0}, NULL, 0, 0, 1, NULL},
    {"a column is missing",
     {.column = FC_GX, .drop = true},
     NULL,
     0,
     0,
     1,
     "without rates no moment is compared"},
    {"a column has another name",
     {.column = FC_GX, .rename = "gyro_x"},
     NULL,
     0,
     0,
     1,
     "without rates no moment is compared"},
    {"no time",
     {.column = FC_TIME, .drop = true},
     "f.csv:1: column timestamp: missing; it is the signal `time` of this kind of log",
     0,
     0,
     0,
     NULL},
    {"a column stands twice",
     {.column = FC_GX, .rename = "gyro.y"},
     "f.csv:1: column gyro.y: the name stands twice, in cells 15 and 16; allowed: once",
     0,
     0,
     0,
     NULL},
    {"nan", {.column = FC_AX, .cell = "nan", .every = 25}, NULL, 0, 80, 1, "80 cells are empty or nan"},
    {"empty", {.column = FC_VZ, .cell = "", .every = 25}, NULL, 0, 80, 1, "80 cells are empty or nan"},
    {"much empty",
     {.column = FC_VZ, .cell = "", .every = 10},
     "f.csv:12: column stateEstimate.vz: 9.95 % of its cells are empty, from here on; allowed: 5 %",
     0,
     0,
     0,
     NULL},
    {"a fifth empty",
     {.column = FC_M3, .cell = "nan", .every = 5},
     "f.csv:7: column motor.m3: 20 % of its cells are empty, from here on; allowed: 5 %",
     0,
     0,
     0,
     NULL},
    {"a voltage now and then", {.column = FC_VBAT, .cell = "", .every = 2}, NULL, 0, 1000, 1, NULL},
    {"out of range",
     {.column = FC_GX, .cell = "9e5", .every = 50},
     NULL,
     40,
     0,
     1,
     "f.csv:2: column gyro.x: the first of 40 cells that are no numbers or out of range; they are left out"},
    {"a command below nothing",
     {.column = FC_M2, .cell = "-300", .every = 500},
     NULL,
     0,
     0,
     1,
     "4 motor commands below 0 or above full are taken as 0 or full"},
    {"a command above full",
     {.column = FC_M2, .cell = "70000", .every = 500},
     NULL,
     0,
     0,
     1,
     "4 motor commands below 0 or above full are taken as 0 or full"},
    {"no command at all",
     {.column = FC_M2, .cell = "7e6", .every = 10},
     "f.csv:2: column motor.m2: 7e+06 pwm is not plausible; allowed: 0 to 65536 pwm, the first of 200 such "
     "cells in 2000 rows; allowed: 5 %",
     0,
     0,
     0,
     NULL},
    {"a motor without a column",
     {.column = FC_M3, .drop = true},
     "f.csv:1: column motor.m1: without a column for m3; allowed: all four motors",
     0,
     0,
     0,
     NULL},
    {"2 g on average", {.column = FC_AX, .offset = 1.7}, NULL, 0, 0, 1, NULL},
    {"no quaternion now and then", {.column = FC_QW, .cell = "0.2", .every = 50}, NULL, 40, 0, 1, NULL},
    {"infinite",
     {.column = FC_GX, .cell = "inf", .every = 50},
     NULL,
     40,
     0,
     1,
     "f.csv:2: column gyro.x: the first of 40 cells that are no numbers or out of range; they are left out"},
    {"text",
     {.column = FC_Z, .cell = "x1", .every = 50},
     NULL,
     40,
     0,
     1,
     "f.csv:2: column stateEstimate.z: the first of 40 cells that are no numbers or out of range; they are "
     "left out"},
    {"much text",
     {.column = FC_Z, .cell = "x1", .every = 10},
     "f.csv:2: column stateEstimate.z: not a number, the first of 200 such cells in 2000 rows; allowed: 5 %",
     0,
     0,
     0,
     NULL},
    {"no time in a row",
     {.column = FC_TIME, .cell = "", .every = 1000},
     "f.csv:2: column timestamp: a gap; allowed: a number",
     0,
     0,
     0,
     NULL},
    {"decimal comma",
     {.column = FC_VBAT, .cell = "\"3,7\""},
     "f.csv:2: column pm.vbat: decimal comma in `3,7`; allowed: `.`",
     0,
     0,
     0,
     NULL},
    {"a gap of 20 ms", {.from_s = 5.0, .gap_rows = 2}, NULL, 0, 0, 1, NULL},
    {"a gap of 1 s", {.from_s = 5.0, .gap_rows = 100}, NULL, 0, 0, 2, "gaps in time split the flight: 1"},
    {"time that stands",
     {.from_s = 5.0, .same_rows = 1},
     NULL,
     0,
     0,
     1,
     "1 rows of the same or almost the same time as the one before are merged"},
    {"time that runs back",
     {.column = FC_TIME, .offset = -500.0, .from_s = 5.0},
     "f.csv:502: column timestamp: 4.5 s after 4.99 s; allowed: time that increases from row to row",
     0,
     0,
     0,
     NULL},
    {"upside down to the end",
     {.column = FC_QW, .more = 1, .scale = -1.0, .offset = 1.0, .from_s = 18.0}, // w for x
     NULL,
     0,
     0,
     1,
     "from 18.00 s on it is tilted by more than 90 degrees, to the end"},
    {"upside down to the end, of which the last row is missing",
     {.column = FC_QW, .more = 1, .scale = -1.0, .offset = 1.0, .from_s = 18.0, .cell = "nan", .every = 1999},
     NULL,
     0,
     2,
     1,
     "from 18.00 s on it is tilted by more than 90 degrees, to the end"},
    {"upside down for a while",
     {.column = FC_QW, .more = 1, .scale = -1.0, .offset = 1.0, .from_s = 17.0, .to_s = 18.0},
     NULL,
     0,
     0,
     1,
     NULL},
    {"without an attitude from 18 s on",
     {.column = FC_QW, .from_s = 18.0, .scale = (double)NAN},
     NULL,
     0,
     200,
     1,
     NULL},
};

static bool noted(const gap_flight_t *f, const char *text) {
  for (int i = 0; i < f->n_note; i++)
    if (strstr(f->note[i], text)) return true;
  return false;
}

TEST(gap_splits_counts_or_refuses_what_is_wrong_in_rows_and_cells) {
  for (unsigned i = 0; i < sizeof spoilt / sizeof *spoilt; i++) {
    ROW("%s", spoilt[i].what);
    gap_flight_t f;
    why_t why = {""};
    CHECK_STATUS(spoilt[i].want ? BAD_INPUT : DONE, read_made(&f, &spoilt[i].made, &why));
    CHECK_TEXT(scratch_short(why.text), spoilt[i].want ? spoilt[i].want : "");
    if (f.n == 0) continue;
    CHECK(f.cells_bad == spoilt[i].bad && f.cells_missing == spoilt[i].missing);
    CHECK(f.segment[f.n - 1] + 1 == spoilt[i].segments);
    if (spoilt[i].note) CHECK(noted(&f, spoilt[i].note));
    CHECK(noted(&f, "tilted") == (spoilt[i].note && strstr(spoilt[i].note, "tilted")));
    CHECK((f.v[SIG_GX] == NULL) ==
          (spoilt[i].made.column == FC_GX && (spoilt[i].made.drop || spoilt[i].made.rename)));
    for (int k = 1; k < 4; k++) CHECK_NEAR(worst(&f, k, 0.0), 0.0, 0.02);
    gap_flight_free(&f);
  }
}

// Accelerations in the world's axes, beside an attitude that is late and says so, or that comes every fifth
// row and repeats itself: as if it were neither.
TEST(gap_turns_accelerations_by_the_attitude_of_their_own_time) {
  static const struct {
    const char *what;
    double late_s;
    int repeats;
    double tol; // of the largest acceleration
  } rows[] = {{"late", 0.02, 0, 0.01}, {"every fifth row", 0.0, 5, 0.03}, {"both", 0.02, 5, 0.03}};
  columns_t columns = flight_csv_columns();
  gap_flight_t plain;
  why_t why = {""};
  columns.acc = ACC_WORLD_WITH_GRAVITY;
  for (int i = SIG_QW; i <= SIG_QZ; i++) columns.of[i].late_said = true;
  CHECK_OK(read_by(&columns, &plain, &(flight_csv_t){.dt_ms = 2.0, .rows = 5000}, &why));
  for (unsigned k = 0; k < sizeof rows / sizeof *rows; k++) {
    ROW("%s", rows[k].what);
    gap_flight_t f;
    double most = 0.0, differ = 0.0;
    int there = 0;
    for (int i = SIG_QW; i <= SIG_QZ; i++) columns.of[i].late_s = rows[k].late_s;
    const flight_csv_t made = {
        .dt_ms = 2.0, .rows = 5000, .late_att_s = rows[k].late_s, .repeats_att = rows[k].repeats};
    CHECK_OK(read_by(&columns, &f, &made, &why));
    CHECK_TEXT(why.text, "");
    const int later = (int)lround((plain.t_s[0] - f.t_s[0]) * plain.rate_Hz); // of this one's samples
    for (int i = 50; i < plain.n - 50; i++) {
      const double is = f.v[SIG_AX][i + later], off = fabs(plain.v[SIG_AX][i] - is);
      most = fmax(most, fabs(plain.v[SIG_AX][i]));
      if (isfinite(off)) differ = fmax(differ, off), there++;
    }
    CHECK(most > 0.3 && there > plain.n - 150);
    CHECK_NEAR(differ / most, 0.0, rows[k].tol);
    gap_flight_free(&f);
  }
  gap_flight_free(&plain);
}

TEST(gap_takes_new_range_samples_alone) {
  gap_flight_t f;
  why_t why = {""};
  static const struct {
    const char *what, *cell;
    int every, least, most;
  } row[] = {{"10 Hz in 100 Hz", NULL, 0, 170, 200},
             {"0 is nothing", "0", 1, 0, 0},
             {"32767 is nothing", "32767", 1, 0, 0},
             {"what does not change is one sample", "400", 1, 1, 1}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK_OK(
        read_made(&f, &(flight_csv_t){.column = FC_RANGE, .cell = row[i].cell, .every = row[i].every}, &why));
    int n = 0;
    for (int k = 0; f.v[SIG_RANGE] && k < f.n; k++) n += isfinite(f.v[SIG_RANGE][k]);
    CHECK(n >= row[i].least && n <= row[i].most);
    CHECK(f.v[SIG_RANGE_DOWN] == NULL);
    gap_flight_free(&f);
  }
}
