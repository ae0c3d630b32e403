// cells.c - stage 1: counts cells that are empty, not numbers or out of range, and refuses too many of them.
#include "gap/1_read/read.h"

#include "base/by_size.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define USUAL 0.6 // share of the intervals between a stream's values that are no longer than its usual one

// True if the signal should have a value in every row, or in one row of a few. Ranges (seen now and then),
// voltage (held) and set points (not always given) may be empty.
static bool is_steady(signal_id_t i) {
  return (i >= SIG_X && i <= SIG_THRUST) || (i >= SIG_TX && i <= SIG_W4);
}

// Returns the time within which most values follow the one before: it is longer where a stream is slower than
// the log. Infinite: fewer than two values.
static double usual_distance_s(const raw_t *raw, const double *v, double *room) {
  int n = 0, last = -1;
  for (int i = 0; i < raw->n; i++) {
    if (isnan(v[i])) continue;
    if (last >= 0) room[n++] = raw->t_s[i] - raw->t_s[last];
    last = i;
  }
  if (n == 0) return HUGE_VAL;
  qsort(room, (size_t)n, sizeof *room, by_size);
  return room[(int)(USUAL * (n - 1))];
}

// Refuses a signal that lacks too many values between its first and its last. Where the rows themselves are
// missing, no value was due.
static done_t refuse_holes(const raw_t *raw, const log_rows_t *rows, signal_id_t signal, double *room,
                           why_t *why) {
  const double *const v = raw->v[signal], usual_s = usual_distance_s(raw, v, room);
  int last = -1, lost = 0, due = 0;
  long line = 0;
  for (int i = 0; i < raw->n; i++) {
    if (isnan(v[i])) continue;
    const double more = last < 0 ? 0.0 : (raw->t_s[i] - raw->t_s[last]) / usual_s - 1.0;
    const int holes = last < 0 ? 0 : (int)fmin(fmax(floor(more + 0.4), 0.0), i - last - 1);
    if (holes > 0 && line == 0) line = raw->line[last + 1];
    lost += holes;
    due += 1 + holes;
    last = i;
  }
  if (lost <= LOG_CELLS_LOST * due) return DONE;
  return table_refuse(&rows->table, line, rows->at[signal], why,
                      "%.3g %% of its cells are empty, from here on; allowed: 5 %%", 100.0 * lost / due);
}

// Refuses a log with columns for only some of the motors: three carry no vehicle, and an invented fourth
// would be named as an effect.
static done_t refuse_some_motors(const log_rows_t *rows, why_t *why) {
  for (int first = SIG_M1; first <= SIG_W1; first += SIG_W1 - SIG_M1) {
    int lacks = -1, there = -1;
    for (int i = first + 3; i >= first; i--) *(rows->at[i] >= 0 ? &there : &lacks) = i;
    if (there < 0 || lacks < 0) continue;
    return table_refuse(&rows->table, 1, rows->at[there], why,
                        "without a column for %s; allowed: all four motors",
                        columns_name((signal_id_t)lacks));
  }
  return DONE;
}

// Refuses commands that cannot be converted to newton, unless rotor speeds say what the motors did.
static done_t refuse_no_newton(const log_rows_t *rows, why_t *why) {
  if (!rows->lacks[0] || (rows->has & SPEEDS) == SPEEDS) return DONE;
  const bool other = strncmp(rows->lacks, "column", 6) == 0; // the text names another column, the voltage's
  return table_refuse(&rows->table, 1, other ? -1 : rows->at[SIG_M1], why, "%s", rows->lacks);
}

static void note_rows(gap_flight_t *f, const raw_t *raw, const log_rows_t *rows) {
  char damage[480];
  why_t first;
  f->cells_bad = log_rows_bad(rows, &first);
  if (f->cells_bad) gap_note(f, "%.190s", first.text);
  if (rows->missing) gap_note(f, "%ld cells are empty or nan", rows->missing);
  if (rows->clipped)
    gap_note(f, "%ld motor commands below 0 or above full are taken as 0 or full", rows->clipped);
  if (table_damage(&rows->table, damage, sizeof damage))
    gap_note(f, "%.170s; what is before it is used", damage);
  if (f->cut)
    gap_note(f, "longer than %.0f min: the rest, from line %ld on, is not used", GAP_FLIGHT_S / 60.0,
             table_line(&rows->table));
  if (raw->merged)
    gap_note(f, "%ld rows of the same or almost the same time as the one before are merged", raw->merged);
  if (raw->thin > 1) gap_note(f, "thinned to means of %d rows", raw->thin);
  if (raw->range_unusable)
    gap_note(f, "%ld range samples of 0 or of no return are left out", raw->range_unusable);
  if (rows->lacks[0]) gap_note(f, "no thrust: %.180s", rows->lacks);
}

done_t gap_check_cells(gap_flight_t *f, const raw_t *raw, const log_rows_t *rows, why_t *why) {
  f->cells_missing = rows->missing;
  f->rows = raw->rows;
  f->motors_N = rows->columns.motors == MOTORS_N;
  for (int i = 0; i < ROTORS; i++)
    if (rows->at[SIG_M1 + i] >= 0)
      memcpy(f->motor_column[i], rows->columns.of[SIG_M1 + i].column, COLUMN_NAME_MAX);
  TRY(refuse_some_motors(rows, why));
  TRY(refuse_no_newton(rows, why));
  TRY(log_rows_check_cells(rows, raw->rows, why));
  double *const room = malloc(((size_t)raw->n + 1) * sizeof *room);
  if (!room) return error_failed(why, "out of memory");
  done_t status = DONE;
  for (int i = 0; i < SIG_COLUMNS && status == DONE; i++)
    if (rows->at[i] >= 0 && raw->v[i] && is_steady((signal_id_t)i))
      status = refuse_holes(raw, rows, (signal_id_t)i, room, why);
  free(room);
  if (status == DONE) note_rows(f, raw, rows);
  return status;
}
