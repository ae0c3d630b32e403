// test_gap_columns_say.c - stage 1: what a columns file says of time, rows, offsets and the battery is taken
// in.
#include "gap/1_read/flight.h"
#include "rig/flight_csv.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

static done_t read_by(const columns_t *columns, gap_flight_t *f, const flight_csv_t *made, why_t *why) {
  model_t vehicle;
  TRY(model_builtin("cf21_legacy", &vehicle, why));
  return gap_read(f, flight_csv_file(made, "f.csv"), columns, &vehicle, why);
}

static done_t read_made(gap_flight_t *f, const flight_csv_t *made, why_t *why) {
  const columns_t columns = flight_csv_columns();
  return read_by(&columns, f, made, why);
}

// A log whose force, rates and range tell what was: everything else is early by as much.
TEST(gap_takes_out_the_delays_that_the_columns_name) {
  static const double late_s = 0.02;
  columns_t columns = flight_csv_columns();
  const flight_csv_t made = {.dt_ms = 10.0, .late_att_s = -late_s, .late_vel_s = -late_s};
  for (int s = SIG_AX; s <= SIG_AZ; s++) columns.of[s].late_s = late_s;
  for (int s = SIG_GX; s <= SIG_GZ; s++) columns.of[s].late_s = late_s;
  columns.of[SIG_RANGE].late_s = late_s;
  gap_flight_t f;
  why_t why = {""};
  CHECK_OK(read_by(&columns, &f, &made, &why));
  CHECK_TEXT(why.text, "");
  CHECK(f.n > 1900 && f.attitude_late_s == 0.0 && f.velocity_late_s == 0.0);
  for (int k = 100; k < 1900; k++) {
    double v[FC_COLUMNS], then[FC_COLUMNS];
    flight_csv_values(f.t_s[k] + late_s, v);
    CHECK_NEAR(f.v[SIG_GY][k], v[FC_GY] * 3.14159265358979323846 / 180.0, 1e-6);
    CHECK_NEAR(f.v[SIG_AZ][k], v[FC_AZ] * 9.81, 1e-6);
    flight_csv_values(f.t_s[k], then);
    if (!CHECK_NEAR(f.v[SIG_QX][k], v[FC_QX], 1e-6) ||
        !CHECK_NEAR(f.v[SIG_W3][k], then[FC_W3] * 0.1047198, 0.01))
      break;
    if (isfinite(f.v[SIG_RANGE][k])) CHECK_NEAR(f.v[SIG_RANGE][k], 1e-3 * v[FC_RANGE], 1e-9);
  }
  gap_flight_free(&f);
}

// Commands that were logged late, or early, are those of the same log of commands in time.
TEST(gap_takes_out_the_lateness_of_commands) {
  static const struct {
    const char *what;
    double dt_ms, late_s;
  } row[] = {{"in time", 10.0, 0.0},
             {"a row late", 10.0, 0.01},
             {"a row early", 10.0, -0.01},
             {"five rows late", 2.0, 0.01},
             {"a row and a half late", 10.0, 0.015}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    columns_t columns = flight_csv_columns();
    const flight_csv_t made = {.dt_ms = row[i].dt_ms, .late_cmd_s = row[i].late_s};
    for (int s = SIG_M1; s <= SIG_M4; s++) columns.of[s].late_s = row[i].late_s;
    gap_flight_t late, now;
    why_t why = {""};
    CHECK_OK(read_by(&columns, &late, &made, &why));
    CHECK_TEXT(why.text, "");
    CHECK_OK(read_made(&now, &(flight_csv_t){.dt_ms = row[i].dt_ms}, &why));
    for (int k = 0; k < late.n; k++) {
      double v[FC_COLUMNS];
      flight_csv_values(late.t_s[k], v);
      const int same = (int)((late.t_s[k] - now.t_s[0]) * now.rate_Hz + 0.5);
      // Between rows a command is drawn as a line: 5 ms from either 1 % of a wave of 1 Hz is the bow.
      // The voltage is of its own row: 20 uV.
      const double tol = row[i].late_s * 1e3 / row[i].dt_ms == 1.5 ? 0.01 : 3e-5;
      CHECK_NEAR(late.v[SIG_M2][k], v[FC_M2], tol * v[FC_M2]);
      CHECK_NEAR(late.v[SIG_THRUST][k], now.v[SIG_THRUST][same], tol * now.v[SIG_THRUST][same]);
      if (!CHECK_NEAR(late.v[SIG_F3][k], now.v[SIG_F3][same], tol * now.v[SIG_F3][same])) break;
    }
    gap_flight_free(&late);
    gap_flight_free(&now);
  }
}

// What the file says of a stream stands, in time too; of the other one nothing is said.
TEST(gap_does_not_move_a_stream_of_which_the_columns_file_says_how_late_it_is) {
  static const double late_s = 0.005;
  const flight_csv_t made = {.dt_ms = 2.0, .rows = 10000, .late_att_s = late_s, .late_vel_s = late_s};
  static const signal_id_t of[] = {SIG_TIME, SIG_QY, SIG_VX, SIG_PITCH};
  for (int said = 0; said < 4; said++) {
    ROW("%s",
        (const char *const[]){"nothing said", "of the attitude", "of the velocity", "of an angle"}[said]);
    columns_t columns = flight_csv_columns();
    columns.of[of[said]].late_said = said > 0;
    gap_flight_t f;
    why_t why = {""};
    CHECK_OK(read_by(&columns, &f, &made, &why));
    CHECK_TEXT(why.text, "");
    CHECK(said == 1 || said == 3 ? f.attitude_late_s == 0.0 : f.attitude_late_s > 0.5 * late_s);
    if (said == 2) CHECK(f.velocity_late_s == 0.0);
    if (said == 0) CHECK(f.velocity_late_s > 0.5 * late_s);
    gap_flight_free(&f);
  }
}

// Attitude and place that the columns file says are late are not late beyond that.
TEST(gap_takes_out_the_lateness_of_the_estimate) {
  static const double late_s = 0.06; // more than could be mended
  columns_t columns = flight_csv_columns();
  for (int s = SIG_X; s <= SIG_VZ; s++) columns.of[s].late_s = late_s;
  for (int s = SIG_QW; s <= SIG_QZ; s++) columns.of[s].late_s = late_s;
  gap_flight_t f;
  why_t why = {""};
  CHECK_OK(
      read_by(&columns, &f, &(flight_csv_t){.dt_ms = 2.0, .late_att_s = late_s, .late_vel_s = late_s}, &why));
  CHECK_TEXT(why.text, "");
  CHECK_NEAR(f.attitude_late_s, 0.0, 3e-4);
  CHECK_NEAR(f.velocity_late_s, 0.0, 5e-4);
  for (int k = 0; k < f.n; k++) {
    double v[FC_COLUMNS];
    flight_csv_values(f.t_s[k], v);
    CHECK_NEAR(f.v[SIG_X][k], v[FC_X], 2e-3);
    if (!CHECK_NEAR(f.v[SIG_QX][k], v[FC_QX], 1e-3)) break;
  }
  gap_flight_free(&f);
}

TEST(gap_reads_whether_rows_are_means) {
  static const struct {
    const char *what;
    double dt_ms;
    bool said, want;
  } row[] = {{"instants", 10.0, false, false}, {"means", 10.0, true, true}, {"thinned", 1.0, false, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    columns_t columns = flight_csv_columns();
    columns.rows_are_means = row[i].said;
    gap_flight_t f;
    why_t why = {""};
    CHECK_OK(read_by(&columns, &f, &(flight_csv_t){.dt_ms = row[i].dt_ms}, &why));
    CHECK(f.rows_are_means == row[i].want);
    gap_flight_free(&f);
  }
}

// Without a battery the user says what the voltage is.
TEST(gap_takes_a_voltage_that_stands_in_the_columns_file) {
  static const struct {
    const char *what;
    double scale; // of a motor's commands: what a trim may be
    bool constant;
  } row[] = {{"measured", 1.0, false}, {"said", 1.0, true}, {"trim", 0.7, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    columns_t columns = flight_csv_columns();
    const flight_csv_t made = {.column = FC_M2, .scale = row[i].scale};
    if (row[i].constant)
      columns.of[SIG_VBAT] = (column_t){.unit = "V", .factor = 1.0, .offset = 3.9, .constant = true};
    gap_flight_t f;
    why_t why = {""};
    CHECK_OK(read_by(&columns, &f, &made, &why));
    CHECK_TEXT(why.text, "");
    CHECK(f.n > 1900 && f.v[SIG_F1] != NULL);
    for (int k = 0; k < f.n; k++)
      if (row[i].constant && !CHECK_NEAR(f.v[SIG_VBAT][k], 3.9, 1e-12)) break;
    gap_flight_free(&f);
  }
}

TEST(gap_takes_a_range_that_an_offset_makes_negative) {
  columns_t columns = flight_csv_columns();
  columns.of[SIG_RANGE].offset = -0.45; // of a sensor high above what it is counted from
  columns.of[SIG_RANGE].factor = 0.5e-3;
  gap_flight_t f;
  why_t why = {""};
  CHECK_OK(read_by(&columns, &f, &(flight_csv_t){.dt_ms = 10.0}, &why));
  CHECK_TEXT(why.text, "");
  int n = 0, below = 0;
  for (int k = 0; k < f.n; k++) {
    n += isfinite(f.v[SIG_RANGE][k]);
    below += f.v[SIG_RANGE][k] < 0.0;
  }
  CHECK(n > 170 && below > 5);
  CHECK(f.cells_bad == 0);
  gap_flight_free(&f);
}

// How many samples are those that the log has so long after their instants.
static int samples_at(const gap_flight_t *f, double after_s) {
  int n = 0;
  for (int k = 0; k < f->n; k++) {
    double v[FC_COLUMNS];
    flight_csv_values(f->t_s[k] + after_s, v);
    n += isfinite(f->v[SIG_RANGE][k]) && fabs(f->v[SIG_RANGE][k] - 1e-3 * v[FC_RANGE]) < 1e-9;
  }
  return n;
}

// A sample's age: of the column, else of the vehicle, and half a period of a log that is quicker than the
// sensor.
TEST(gap_knows_how_old_a_range_sample_is) {
  static const struct {
    const char *what;
    double dt_ms, late_s, age_s, want_s;
    bool late_said, told, means;
  } row[] = {
      {"nobody says it", 10.0, 0.0, 0.0, 0.005, false, false, false},
      {"as a Crazyflie's", 10.0, 0.07, 0.0, 0.075, false, false, false},
      {"the vehicle file", 10.0, 0.07, 0.033, 0.038, false, true, false},
      {"the columns file", 10.0, 0.06, 0.033, 0.065, true, true, false},
      {"a quicker log", 2.0, 0.06, 0.0, 0.061, true, false, false},
      {"means", 10.0, 0.06, 0.0, 0.06, true, false, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    columns_t columns = flight_csv_columns();
    model_t vehicle;
    gap_flight_t f;
    why_t why = {""};
    columns.of[SIG_RANGE].late_s = row[i].late_s;
    columns.of[SIG_RANGE].late_said = row[i].late_said;
    columns.rows_are_means = row[i].means;
    CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
    vehicle.range_up = (range_told_t){.told = row[i].told, .age_s = row[i].age_s};
    const char *const path = flight_csv_file(&(flight_csv_t){.dt_ms = row[i].dt_ms}, "f.csv");
    CHECK_OK(gap_read(&f, path, &columns, &vehicle, &why));
    CHECK_TEXT(why.text, "");
    CHECK(f.range_late_s[0] >= 0.0 && f.range_late_s[0] < 1e-3 * row[i].dt_ms);
    const double row_s = row[i].want_s - f.range_late_s[0]; // from the instant
    // It stands in that row, and not in the one before.
    CHECK(samples_at(&f, row_s) - samples_at(&f, row_s - 1e-3 * row[i].dt_ms) > 7.0 * f.t_s[f.n - 1]);
    gap_flight_free(&f);
  }
}
