// test_gap_files.c - stage 1 on files as they come: line ends, separators, what is no log, long logs.
#define _XOPEN_SOURCE 700 // alarm, symlink, popen
#include "gap/1_read/flight.h"
#include "logs/log_rows.h"
#include "rig/flight_csv.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static done_t read_log(gap_flight_t *f, const char *path, why_t *why) {
  const columns_t columns = flight_csv_columns();
  model_t vehicle;
  TRY(model_builtin("cf21_legacy", &vehicle, why));
  return gap_read(f, path, &columns, &vehicle, why);
}

// The text with every `from` replaced, points not in the names.
static char *replaced(const char *text, char from, const char *to) {
  char *const made = malloc(strlen(text) * (strlen(to) + 1) + 8), *at = made;
  if (!made) abort();
  for (bool names = true; *text; text++) {
    names = names && *text != '\n';
    if (*text == from && !(names && from == '.'))
      at = stpcpy(at, to);
    else
      *at++ = *text;
  }
  *at = '\0';
  return made;
}

// Row 56 of the faults.
static const struct {
  const char *what, *before;
  char from;
  const char *to;
  int cut; // bytes at the end
  const char *want, *note;
} written[] = {
    {"plain", "", '\n', "\n", 0, NULL, NULL},
    {"CRLF", "", '\n', "\r\n", 0, NULL, NULL},
    {"byte order mark", "\xEF\xBB\xBF", '\n', "\n", 0, NULL, NULL},
    {"last line cut off", "", '\n', "\n", 60, NULL,
     "f.csv:501: the file is cut off in this row; what is before it is used"},
    {"semicolons", "", ',', ";", 0,
     "f.csv:1: the separator is `;`; allowed: `,` between cells and `.` in numbers", NULL},
    {"decimal commas", "", '.', ",", 0, "f.csv:2: ", NULL},
};

TEST(gap_reads_what_programs_write_to_the_bit) {
  const size_t room = 1u << 20;
  char *const text = malloc(room);
  if (!text) abort();
  flight_csv_write(&(flight_csv_t){.rows = 500}, text, room);
  gap_flight_t plain, f;
  why_t why = {""};
  CHECK_OK(read_log(&plain, scratch_file("f.csv", text, -1), &why));
  for (unsigned i = 0; i < sizeof written / sizeof *written; i++) {
    ROW("%s", written[i].what);
    char *const rows = replaced(text, written[i].from, written[i].to);
    char *const all = malloc(strlen(rows) + 8);
    if (!all) abort();
    sprintf(all, "%s%s", written[i].before, rows);
    const char *const path = scratch_file("f.csv", all, (long)strlen(all) - written[i].cut);
    CHECK_STATUS(written[i].want ? BAD_INPUT : DONE, read_log(&f, path, &why));
    free(rows);
    free(all);
    if (written[i].want) {
      if (!strstr(why.text, written[i].want)) CHECK_TEXT(why.text, written[i].want);
      continue;
    }
    CHECK(f.n == plain.n - (written[i].cut > 0));
    for (int k = 0; k < f.n - 2; k++)
      if (!CHECK_NEAR(f.v[SIG_Z][k], plain.v[SIG_Z][k], written[i].cut ? 1e-9 : 0.0)) break;
    CHECK(f.n_note == (written[i].note != NULL));
    if (written[i].note) CHECK_TEXT(scratch_short(f.note[0]), written[i].note);
    gap_flight_free(&f);
  }
  gap_flight_free(&plain);
  free(text);
}

// Row 58: nothing hangs. The alarm ends the tests if something does.
TEST(gap_refuses_what_is_no_log_at_once) {
  char loop[400], folder[400];
  snprintf(loop, sizeof loop, "%s", scratch_path("loop.csv"));
  snprintf(folder, sizeof folder, "%s", scratch_path("hollow"));
  CHECK(mkdir(folder, 0700) == 0);
  CHECK(symlink("loop.csv", loop) == 0);
  const struct {
    const char *path, *want;
  } row[] = {{loop, "loop.csv: cannot be opened: Too many levels of symbolic links"},
             {folder, "hollow: cannot be read: Is a directory"},
             {"/dev/zero", "/dev/zero:1: not a text file; allowed: CSV"},
             {"/dev/null", "/dev/null:1: the file is empty; allowed: a row of names and rows of numbers"},
             {"/none/of/this", "/none/of/this: cannot be opened: No such file or directory"}};
  alarm(5);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].want);
    gap_flight_t f;
    columns_t columns;
    model_t model;
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, read_log(&f, row[i].path, &why));
    CHECK(strstr(scratch_short(why.text), row[i].want) ==
          scratch_short(why.text)); // a folder: and what may be in it
    CHECK_STATUS(BAD_INPUT, columns_read(row[i].path, &columns, &why));
    CHECK_STATUS(BAD_INPUT, model_read(row[i].path, &model, &why));
  }
  alarm(0);
}

TEST(gap_takes_half_an_hour_of_a_longer_log_and_says_so) {
  const char *const path = scratch_path("long.csv");
  FILE *const file = fopen(path, "w");
  if (!file) abort();
  fprintf(file, "timestamp,stateEstimate.z\n");
  for (int i = 0; i < 110000; i++) fprintf(file, "%d,%d.%03d\n", 20 * i, i % 2, i % 1000);
  fclose(file);
  gap_flight_t f;
  why_t why = {""};
  CHECK_OK(read_log(&f, path, &why));
  CHECK_TEXT(why.text, "");
  CHECK(f.cut && f.n == 90001 && f.rows == 90001);
  CHECK_NEAR(f.t_s[f.n - 1], GAP_FLIGHT_S, 1e-6);
  CHECK_TEXT(f.note[0], "longer than 30 min: the rest, from line 90003 on, is not used");
  gap_flight_free(&f);
}

#if defined __SANITIZE_ADDRESS__
#define LIMIT "" // the sanitizer reserves terabytes
#else
#define LIMIT "ulimit -v 65536;"
#endif

// Row 55 of the faults: ten gigabytes through a pipe into 64 MB, the program's libraries counted; 0.07 in
// the short tests. The log is read by this program itself, in the two tests below.
static void stream(double gigabytes, const char *test) {
  char line[1200], text[600], want[80];
  const double rows = floor(gigabytes * 1e9 / 494.0);
  snprintf(line, sizeof line,
           "awk -v rows=%.0f 'BEGIN { printf "
           "\"timestamp,stateEstimate.x,stateEstimate.y,stateEstimate.z,stateEstimate.qw,"
           "stateEstimate.qx,stateEstimate.qy,stateEstimate.qz,acc.x,acc.y,acc.z,motor.m1,motor.m2,motor.m3,"
           "motor.m4,pm.vbat,"
           "text\\n\"; for (i = 0; i < 400; i++) pad = pad \"0\"; for (i = 0; i < rows; i++) "
           "printf "
           "\"%%d,0,0,0.%%d,1,0.00%%d,0,0,0.1%%d,0.2%%d,1.0%%d,4%%d000,41%%d00,42000,43000,3.7%%d,%%s\\n\", "
           "10 * i, 4 + i %% 2, i %% 5, i %% 3, i %% 5, i %% 3, i %% 3, i %% 7, i %% 4, pad }' | "
           "(" LIMIT " STREAM_ROWS=%.0f tests %s)",
           rows, rows, test);
  CHECK_NEAR(program_run(line, STREAM_OUTPUT, text, sizeof text), 0.0, 0.0);
  snprintf(want, sizeof want, "test_gap_files.c                1 passed    0 failed\n1 passed, 0 failed\n");
  CHECK_TEXT(text, want);
}

TEST(gap_rows_of_a_log_of_any_length_pass_through_64_megabytes) {
  stream(test_long() ? 10.0 : 0.07, "stream_all");
}

TEST(gap_reads_half_an_hour_of_a_log_of_any_length_in_64_megabytes) {
  stream(0.2, "stream_flight"); // no more of it is read than is used
}

TEST(stream_all) {
  const char *const rows = getenv("STREAM_ROWS");
  if (!rows) SKIP("reads the standard input; the test of long logs starts it");
  const columns_t columns = flight_csv_columns();
  log_rows_t log;
  log_row_t row;
  model_t vehicle;
  why_t why;
  bool more = true;
  double n = 0.0;
  CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
  CHECK_OK(log_rows_open(&log, "/dev/stdin", &columns, &vehicle, LOG_STRICT, 0, &why));
  while (log_rows_next(&log, &row, &more, &why) == DONE && more) n += 1.0;
  log_rows_close(&log);
  CHECK_NEAR(n, atof(rows), 0.0);
}

TEST(stream_flight) {
  if (!getenv("STREAM_ROWS")) SKIP("reads the standard input; the test of long logs starts it");
  gap_flight_t f;
  why_t why = {""};
  CHECK_OK(read_log(&f, "/dev/stdin", &why));
  CHECK_TEXT(why.text, "");
  CHECK(f.cut && f.n == 180001);
  gap_flight_free(&f);
}
