// test_blocks.c - the files of one flight that cfclient writes, packed or not, as one log.
#include "gap/1_read/flight.h"
#include "logs/log_rows.h"
#include "rig/flight_csv.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <string.h>

// Columns of the log by block; each has a phase of its own.
static const struct {
  const char *name;
  int first, n;
  double phase_s;
} BLOCK[] = {{"pose", FC_X, 6, 0.0},    {"imu", FC_AX, 3, 0.003},    {"att", FC_QW, 4, 0.001},
             {"gyro", FC_GX, 3, 0.005}, {"motors", FC_M1, 5, 0.002}, {"range", FC_RANGE, 1, 0.004}};
#define BLOCKS ((int)(sizeof BLOCK / sizeof *BLOCK))

static void write_block(int k, const char *path) {
  FILE *const file = fopen(path, "w");
  if (!file) return;
  fputs("Timestamp", file);
  for (int c = 0; c < BLOCK[k].n; c++) fprintf(file, ",%s", flight_csv_name[BLOCK[k].first + c]);
  for (int i = 0; i < 2000; i++) {
    double v[FC_COLUMNS];
    const double t_s = 0.01 * i + BLOCK[k].phase_s;
    flight_csv_values(t_s, v);
    fprintf(file, "\n%.0f", 1e3 * t_s);
    for (int c = 0; c < BLOCK[k].n; c++) fprintf(file, ",%.9g", v[BLOCK[k].first + c]);
  }
  fputc('\n', file);
  CHECK(fclose(file) == 0);
}

static void write_blocks(void) {
  char text[200], name[40];
  CHECK(program_run("rm -rf $S/blocks; mkdir $S/blocks", STREAM_OUTPUT, text, sizeof text) == 0);
  for (int k = 0; k < BLOCKS; k++) {
    snprintf(name, sizeof name, "blocks/%s-1.csv", BLOCK[k].name);
    write_block(k, scratch_path(name));
  }
}

static done_t read_flight(gap_flight_t *f, const char *path, why_t *why) {
  const columns_t columns = flight_csv_columns();
  model_t vehicle;
  TRY(model_builtin("cf21_legacy", &vehicle, why));
  return gap_read(f, path, &columns, &vehicle, why);
}

TEST(blocks_of_a_flight_are_one_log_by_folder_by_name_and_packed) {
  static const struct {
    const char *what, *make, *paths[3];
  } row[] = {
      {"a folder", ":", {"blocks"}},
      {"names",
       "cd $S/blocks && cat imu-1.csv >../i.csv && cat pose-1.csv >../p.csv && cat motors-1.csv >../m.csv",
       {"p.csv", "i.csv", "m.csv"}},
      {"packed", "gzip -f $S/blocks/imu-1.csv $S/blocks/motors-1.csv", {"blocks"}}};
  write_blocks();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    char text[300], path[900] = "";
    CHECK(program_run(row[i].make, STREAM_OUTPUT, text, sizeof text) == 0);
    for (int k = 0; k < 3 && row[i].paths[k]; k++) {
      const size_t used = strlen(path);
      snprintf(path + used, sizeof path - used, "%s%s", used ? "+" : "", scratch_path(row[i].paths[k]));
    }
    gap_flight_t f;
    why_t why = {""};
    CHECK_OK(read_flight(&f, path, &why));
    CHECK_TEXT(why.text, "");
    CHECK_NEAR(f.rate_Hz, 100.0, 0.01);
    CHECK(f.n > 1950 && f.v[SIG_X] && f.v[SIG_AZ] && f.v[SIG_F1]);
    for (int k = 5; k < f.n - 5; k++) {
      double v[FC_COLUMNS];
      flight_csv_values(f.t_s[k], v);
      CHECK_NEAR(f.v[SIG_M2][k], v[FC_M2], 1e-4 * v[FC_M2]); // the rows are those of the commands
      CHECK_NEAR(f.v[SIG_X][k], v[FC_X], 1e-3);
      if (!CHECK_NEAR(f.v[SIG_AZ][k], 9.81 * v[FC_AZ], 0.05)) break;
    }
    gap_flight_free(&f);
  }
}

// The sensor reads every 0.1 s. Its file has that 4 ms later (half a period, 5 ms, is taken for it), the
// motors' row another 8 ms later.
TEST(blocks_give_a_range_the_time_of_its_own_file) {
  gap_flight_t f;
  why_t why = {""};
  int samples = 0;
  write_blocks();
  if (!CHECK_OK(read_flight(&f, scratch_path("blocks"), &why))) return;
  for (int k = 0; k < f.n; k++) {
    if (!isfinite(f.v[SIG_RANGE][k])) continue;
    const double taken_s = f.t_s[k] - f.range_late_s[0];
    samples++;
    if (!CHECK_NEAR(taken_s, 0.1 * round(taken_s / 0.1) - 0.001, 5e-4)) break;
  }
  CHECK(samples > 100);
  gap_flight_free(&f);
}

// A range at 4, 14, .. ms stands in rows at 12, 22, ..: told as new there, it would be a late sensor.
TEST(blocks_tell_how_long_ago_a_range_was_new) {
  static const struct {
    const char *column;
    double late_s, apart_s;
  } row[] = {{"range.up", 0.008, 0.010}, {"motor.m1", 0.0, 0.0}};
  table_t t;
  why_t why;
  bool more = true;
  write_blocks();
  if (!CHECK_OK(table_open_flight(&t, scratch_path("blocks"), &why))) return;
  while (more && CHECK_OK(table_next(&t, &more, &why))) {
  }
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].column);
    const blocks_times_t times = table_times(&t, table_find(&t, row[i].column));
    CHECK_NEAR(times.late_s, row[i].late_s, 1e-4);
    CHECK_NEAR(times.apart_s, row[i].apart_s, 1e-4);
  }
  table_close(&t);
}

TEST(blocks_that_are_no_flight_are_refused_in_one_line) {
  static const struct {
    const char *make, *path, *want;
  } row[] = {
      {"cp $S/blocks/imu-1.csv $S/blocks/imu-2.csv", "blocks", "imu-2.csv:1: column acc.x: stands in "},
      {"rm $S/blocks/imu-2.csv; printf 'a,b\\n1,2\\n' >$S/blocks/other.csv", "blocks",
       "other.csv:1: no column Timestamp; allowed: files of cfclient, one for each log block of a flight"},
      {"rm $S/blocks/other.csv; sed -i '500s/^[0-9]*/1/' $S/blocks/imu-1.csv", "blocks",
       "imu-1.csv:500: column Timestamp: 1 ms after 4973 ms; allowed: time that increases from row to row"},
      {"mkdir -p $S/empty", "empty",
       "empty: cannot be read: Is a directory; allowed: a log, or a folder with the .csv files of one "
       "flight"},
  };
  write_blocks();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].want);
    char text[300];
    gap_flight_t f;
    why_t why = {""};
    CHECK(program_run(row[i].make, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK_STATUS(BAD_INPUT, read_flight(&f, scratch_path(row[i].path), &why));
    if (!strstr(why.text, row[i].want)) CHECK_TEXT(why.text, row[i].want);
  }
}

// The number of rows of a table.
static int rows_of(const char *path, why_t *why, done_t *status) {
  table_t t;
  bool more = true;
  int n = 0;
  *status = table_open(&t, path, why);
  if (*status != DONE) return 0;
  while ((*status = table_next(&t, &more, why)) == DONE && more) n++;
  table_close(&t);
  return n;
}

TEST(packed_logs_are_read_as_they_are) {
  static const struct {
    const char *what, *make;
    int rows;
    const char *want; // of the error; null: none
  } row[] = {
      {"whole", "gzip -c $S/plain.csv >$S/p.gz", 2000, NULL},
      {"two files behind each other",
       "{ head -n 1000 $S/plain.csv | gzip; tail -n +1001 $S/plain.csv | gzip; } >$S/p.gz", 2000, NULL},
      {"not gzip's", "{ printf '\\037\\213xxxxxxxxxxxxxxxxxxxx'; cat $S/plain.csv; } >$S/p.gz", 0,
       "cannot be read"},
  };
  (void)flight_csv_file(&(flight_csv_t){.rows = 2000}, "plain.csv");
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    char text[300];
    why_t why = {""};
    done_t status;
    CHECK(program_run(row[i].make, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK(rows_of(scratch_path("p.gz"), &why, &status) == row[i].rows);
    CHECK(status == (row[i].want ? BAD_INPUT : DONE));
    if (row[i].want) CHECK(strstr(why.text, row[i].want) != NULL);
  }
}

// What a Crazyflie's log has under other names and units.
TEST(columns_of_a_crazyflie_have_other_names) {
  const columns_t c = columns_crazyflie();
  const char *const csv =
      "Timestamp,stateEstimateZ.x,kalman.stateZ,stateEstimateZ.vx,stabilizer.roll,stabilizer.pitch,"
      "pm.vbatMV\n1500,250,0.4,-120,0,-90,3950\n";
  log_rows_t rows;
  log_row_t row;
  model_t vehicle;
  why_t why = {""};
  bool more;
  CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
  CHECK_OK(log_rows_open(&rows, scratch_file("also.csv", csv, -1), &c, &vehicle, LOG_STRICT, 0, &why));
  CHECK_OK(log_rows_next(&rows, &row, &more, &why));
  CHECK_NEAR(row.v[SIG_TIME], 1.5, 1e-12);
  CHECK_NEAR(row.v[SIG_X], 0.25, 1e-12);
  CHECK_NEAR(row.v[SIG_Z], 0.4, 1e-12);
  CHECK_NEAR(row.v[SIG_VX], -0.12, 1e-12);
  CHECK_NEAR(row.v[SIG_QY], 0.70710678, 1e-6);
  CHECK_NEAR(row.v[SIG_VBAT], 3.95, 1e-12);
  log_rows_close(&rows);
}
