// test_gap_missing.c - logs in which columns are missing: what is left is used, or it is said what is needed.
#include "gap/diagnose.h"
#include "rig/flight_csv.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const signal_id_t MOTOR[] = {SIG_M1, SIG_M2, SIG_M3, SIG_M4, SIG_W1, SIG_W2, SIG_W3, SIG_W4};
#define MOTORS_ALL 8

static const signal_id_t ANY[] = {SIG_X,  SIG_Y,  SIG_Z,  SIG_VX, SIG_VY, SIG_VZ, SIG_AX,   SIG_AY,   SIG_AZ,
                                  SIG_QW, SIG_QX, SIG_QY, SIG_QZ, SIG_GX, SIG_GY, SIG_GZ,   SIG_M1,   SIG_M2,
                                  SIG_M3, SIG_M4, SIG_W1, SIG_W2, SIG_W3, SIG_W4, SIG_VBAT, SIG_RANGE};
#define ANY_ALL ((int)(sizeof ANY / sizeof *ANY))

typedef struct {
  char path[400];
  model_t vehicle;
  columns_t columns;
} log_t;

static log_t log_of(int rows) {
  log_t log = {.columns = flight_csv_columns()};
  why_t why;
  snprintf(log.path, sizeof log.path, "%s", flight_csv_file(&(flight_csv_t){.rows = rows}, "missing.csv"));
  CHECK_OK(model_builtin("cf21_legacy", &log.vehicle, &why));
  return log;
}

static void leave_out(log_t *log, signal_id_t signal) {
  log->columns.of[signal].column[0] = '\0';
}

static bool whole(const log_t *log, signal_id_t first, int n) {
  for (int i = 0; i < n; i++)
    if (!log->columns.of[(int)first + i].column[0]) return false;
  return true;
}

// To the rows that everything is fitted to.
static done_t to_rows(const gap_flight_t *f, const model_t *vehicle, why_t *why) {
  set_t set = {.grid = NULL};
  grid_t *const grid = calloc(1, sizeof *grid);
  if (!grid) abort();
  done_t status = grid_make(grid, f, 0, f->n, vehicle, why);
  if (status == DONE) {
    status = set_make(&set, grid, 1, why);
    set_free(&set);
    return status;
  }
  grid_free(grid);
  free(grid);
  return status;
}

static done_t to_verdict(gap_flight_t *f, const model_t *vehicle, why_t *why) {
  diagnosis_t *const d = calloc(1, sizeof *d);
  const gap_flights_t flights = {f, 1};
  const diagnose_job_t job = {.fit = &flights, .model = vehicle, .seed = 1};
  if (!d) abort();
  const done_t status = diagnose(&job, d, why);
  diagnosis_free(d);
  free(d);
  return status;
}

// all_stages: through every stage of the workflow.
static done_t take(const log_t *log, bool all_stages, why_t *why) {
  gap_flight_t f;
  done_t status = gap_read(&f, log->path, &log->columns, &log->vehicle, why);
  if (status == DONE)
    status = all_stages ? to_verdict(&f, &log->vehicle, why) : to_rows(&f, &log->vehicle, why);
  gap_flight_free(&f);
  return status;
}

static bool some(const log_t *log, signal_id_t first, int n) {
  bool any = false;
  for (int i = 0; i < n; i++) any = any || log->columns.of[(int)first + i].column[0];
  return any && !whole(log, first, n);
}

// What is said of the motors; null: they are enough.
static const char *refusal(const log_t *log) {
  if (some(log, SIG_M1, 4) || some(log, SIG_W1, 4)) return "; allowed: all four motors";
  if (whole(log, SIG_W1, 4) || (whole(log, SIG_M1, 4) && whole(log, SIG_VBAT, 1))) return NULL;
  if (whole(log, SIG_M1, 4))
    return "missing; the motor commands are there, and the thrust map needs the battery's";
  return "neither motor commands nor rotor speeds; one of them is needed";
}

static void check(const log_t *log, const char *what, bool all_stages) {
  why_t why = {""};
  ROW("%s", what);
  const done_t got = take(log, all_stages, &why);
  const char *const said = refusal(log);
  if (!said) {
    CHECK(got == DONE || strstr(why.text, "no instant at which") != NULL);
    return;
  }
  CHECK(got == BAD_INPUT);
  CHECK(strstr(why.text, said) != NULL);
}

TEST(gap_takes_motors_whole_whichever_of_their_columns_are_missing) {
  const log_t all = log_of(300);
  for (int mask = 0; mask < 1 << MOTORS_ALL; mask++) {
    log_t log = all;
    char what[80] = "without";
    for (int i = 0; i < MOTORS_ALL; i++) {
      if (!(mask & 1 << i)) continue;
      leave_out(&log, MOTOR[i]);
      snprintf(what + strlen(what), sizeof what - strlen(what), " %s", columns_name(MOTOR[i]));
    }
    check(&log, what, test_long());
  }
}

TEST(gap_takes_a_log_of_which_any_two_columns_are_missing) {
  const log_t all = log_of(test_long() ? 300 : 150);
  for (int i = 0; i < ANY_ALL; i++) {
    for (int k = i; k < ANY_ALL; k++) {
      log_t log = all;
      char what[80];
      leave_out(&log, ANY[i]);
      leave_out(&log, ANY[k]);
      snprintf(what, sizeof what, "without %s, %s", columns_name(ANY[i]), columns_name(ANY[k]));
      check(&log, what, i == k || test_long());
    }
  }
}

// A published log has roll and yaw: it was told that it has no attitude, and not what lacks.
TEST(gap_says_which_angle_of_an_attitude_lacks) {
  log_t log = log_of(300);
  const column_t speed[] = {log.columns.of[SIG_VX], log.columns.of[SIG_VY]};
  gap_flight_t f;
  why_t why;
  bool told = false;
  for (int i = SIG_VX; i <= SIG_VZ; i++) leave_out(&log, (signal_id_t)i);
  for (int i = SIG_QW; i <= SIG_QZ; i++) leave_out(&log, (signal_id_t)i);
  log.columns.of[SIG_ROLL] = speed[0]; // any numbers that are small
  log.columns.of[SIG_YAW] = speed[1];
  if (!CHECK_OK(gap_read(&f, log.path, &log.columns, &log.vehicle, &why))) return;
  for (int i = 0; i < f.n_note; i++)
    told = told || strstr(f.note[i], "no pitch: roll and the others beside it are not used") != NULL;
  CHECK(told && !f.v[SIG_QW]);
  gap_flight_free(&f);
}
