// log_rows.c - the rows of a flight log in SI and our frames.
#include "logs/log_rows.h"

#include "base/constants.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define GAP ((double)NAN)

static const signals_t QUATERNION = SIGNALS(SIG_QW, SIG_QZ);
static const signals_t TILT = SIGNAL_BIT(SIG_ROLL) | SIGNAL_BIT(SIG_PITCH);

static bool has(const log_rows_t *r, signals_t bits) {
  return (r->has & bits) == bits;
}

// Finds a signal under another name of a Crazyflie's log; -1: none.
static int find_also(log_rows_t *r, signal_id_t signal) {
  column_t also = r->columns.of[signal];
  for (int i = 0; r->columns.crazyflie && also.column[0] && columns_also(signal, i, &also); i++) {
    const int at = table_find(&r->table, also.column);
    if (at < 0) continue;
    r->columns.of[signal] = also;
    return at;
  }
  return -1;
}

static done_t bind(log_rows_t *r, why_t *why) {
  for (int i = 0; i < SIG_COUNT; i++) {
    const column_t *column = &r->columns.of[i];
    r->at[i] = column->column[0] ? table_find(&r->table, column->column) : -1;
    if (r->at[i] < 0) r->at[i] = find_also(r, (signal_id_t)i);
    if (r->at[i] >= 0 || column->constant) r->has |= SIGNAL_BIT(i);
    if (column->column[0] && r->at[i] < 0 && !column->optional)
      return table_refuse(&r->table, 0, -1, why,
                          "column %s: missing; it is the signal `%s` of this kind of log", column->column,
                          columns_name((signal_id_t)i));
  }
  return DONE;
}

// Adds to r->has what rows deliver beyond the log's own columns.
static done_t derive(log_rows_t *r, why_t *why) {
  if (has(r, TILT)) r->has |= QUATERNION;
  if (r->columns.acc != ACC_BODY && !has(r, QUATERNION)) r->has &= ~SIGNALS(SIG_AX, SIG_AZ);
  log_motors_init(&r->motors, &r->columns, &r->vehicle, &r->has, r->lacks);
  if (!r->lacks[0] || r->care == LOG_MEND) return DONE;
  return table_refuse(&r->table, 0, strncmp(r->lacks, "column", 6) == 0 ? -1 : r->at[SIG_M1], why, "%s",
                      r->lacks);
}

static done_t check_need(const log_rows_t *r, signals_t need, why_t *why) {
  for (int i = 0; i < SIG_COUNT; i++) {
    if (!(need & SIGNAL_BIT(i)) || has(r, SIGNAL_BIT(i))) continue;
    const char *other = i == SIG_THRUST              ? " (or m1..m4)"
                        : i >= SIG_QW && i <= SIG_QZ ? " (or roll and pitch)"
                                                     : "";
    const char *name = r->columns.of[i].column;
    return table_refuse(&r->table, 0, -1, why,
                        "column %s: missing; needed: the signal `%s`%s, named by --columns FILE",
                        name[0] ? name : "?", columns_name((signal_id_t)i), other);
  }
  return DONE;
}

done_t log_rows_open(log_rows_t *r, const char *path, const columns_t *columns, const model_t *vehicle,
                     log_care_t care, signals_t need, why_t *why) {
  *r = (log_rows_t){.columns = *columns, .vehicle = *vehicle, .care = care, .vbat_V = GAP};
  TRY(table_open_flight(&r->table, path, why));
  if (care == LOG_MEND) table_forgive_cut(&r->table);
  done_t status = bind(r, why);
  if (status == DONE) status = derive(r, why);
  if (status == DONE) status = check_need(r, need, why);
  if (status != DONE) log_rows_close(r);
  return status;
}

void log_rows_close(log_rows_t *r) {
  table_close(&r->table);
}

// Reports the first bad cell of a column as an error, with `more` appended.
static done_t refuse_bad(const log_rows_t *r, signal_id_t signal, const char *more, why_t *why) {
  const bad_cells_t *const bad = &r->bad[signal];
  const char *const si = columns_si(&r->columns, signal);
  double min, max;
  char hint[COLUMNS_HINT];
  if (bad->length)
    return table_refuse(&r->table, bad->line, r->at[signal], why,
                        "the quaternion's length is %.3g; allowed: 0.9 to 1.1%s", bad->value, more);
  if (isinf(bad->value))
    return table_refuse(&r->table, bad->line, r->at[signal], why, "not a number%s", more);
  columns_bounds(&r->columns, signal, &min, &max);
  return table_refuse(&r->table, bad->line, r->at[signal], why,
                      "%g %s is not plausible; allowed: %g to %g %s%s%s", bad->value, si, min, max, si,
                      columns_hint(&r->columns, signal, bad->value, min, max, hint), more);
}

done_t log_rows_check_cells(const log_rows_t *r, long rows, why_t *why) {
  for (int i = 0; i < SIG_COLUMNS; i++) {
    const bad_cells_t *const bad = &r->bad[i];
    if ((double)bad->n <= LOG_CELLS_LOST * (double)rows) continue;
    char more[100];
    snprintf(more, sizeof more, ", the first of %ld such cells in %ld rows; allowed: 5 %%", bad->n, rows);
    return refuse_bad(r, (signal_id_t)i, more, why);
  }
  return DONE;
}

long log_rows_bad(const log_rows_t *r, why_t *first) {
  long n = 0;
  int at = -1;
  for (int i = 0; i < SIG_COLUMNS; i++) {
    n += r->bad[i].n;
    if (r->bad[i].n && (at < 0 || r->bad[i].line < r->bad[at].line)) at = i;
  }
  if (at >= 0)
    (void)table_refuse(&r->table, r->bad[at].line, r->at[at], first,
                       "the first of %ld cells that are no numbers or out of range; they are left out", n);
  return n;
}

static done_t take_bad(log_rows_t *r, signal_id_t i, double *value, why_t *why) {
  bad_cells_t *const bad = &r->bad[i];
  if (bad->n++ == 0) *bad = (bad_cells_t){1, table_line(&r->table), *value, false};
  *value = GAP;
  return i == SIG_TIME ? refuse_bad(r, i, "", why) : DONE;
}

// Clips a motor command to its bounds: a controller may ask for less than nothing or more than there is, and
// the motor gives what it can. False: no motor's signal, or too far out of bounds to be a command.
static bool clip_command(log_rows_t *r, signal_id_t i, double min, double max, double *value) {
  const bool newton = r->columns.motors == MOTORS_N;
  if (i < SIG_M1 || i > SIG_M4) return false;
  if (newton && r->vehicle.thrust_min_N >= 0.0 && *value >= min) min = 0.0;
  if (!(*value > min - (max - min) && *value < max + (max - min))) return false;
  const double given = fmin(fmax(*value, min), max);
  r->clipped += given != *value;
  *value = given;
  return true;
}

static done_t read_cell(log_rows_t *r, signal_id_t i, double *value, why_t *why) {
  const csv_gap_t gap = i == SIG_TIME ? CSV_GAP_REFUSED : CSV_GAP_MARKED;
  double min, max;
  TRY(table_number(&r->table, r->at[i], gap, value, why));
  if (isinf(*value)) return take_bad(r, i, value, why);
  if (isnan(*value)) {
    r->missing++;
    return DONE;
  }
  *value = r->columns.of[i].factor * *value + r->columns.of[i].offset;
  columns_bounds(&r->columns, i, &min, &max);
  if (clip_command(r, i, min, max, value) || (*value >= min && *value <= max)) return DONE;
  return take_bad(r, i, value, why);
}

static done_t read_signals(log_rows_t *r, log_row_t *row, why_t *why) {
  for (int i = 0; i < SIG_COUNT; i++) {
    row->v[i] = r->columns.of[i].constant ? r->columns.of[i].offset : GAP;
    if (r->at[i] >= 0) TRY(read_cell(r, (signal_id_t)i, &row->v[i], why));
  }
  return DONE;
}

// Yaw, then pitch, then roll, each about the axis where the one before has put it.
static void quaternion_from_angles(double *v) {
  const double yaw = isfinite(v[SIG_YAW]) ? v[SIG_YAW] : 0.0;
  const double cr = cos(0.5 * v[SIG_ROLL]), sr = sin(0.5 * v[SIG_ROLL]);
  const double cp = cos(0.5 * v[SIG_PITCH]), sp = sin(0.5 * v[SIG_PITCH]);
  const double cy = cos(0.5 * yaw), sy = sin(0.5 * yaw);
  v[SIG_QW] = cr * cp * cy + sr * sp * sy;
  v[SIG_QX] = sr * cp * cy - cr * sp * sy;
  v[SIG_QY] = cr * sp * cy + sr * cp * sy;
  v[SIG_QZ] = cr * cp * sy - sr * sp * cy;
}

static void read_attitude(log_rows_t *r, log_row_t *row) {
  if (!has(r, QUATERNION)) return;
  double *const q = &row->v[SIG_QW], same = 0.0;
  if (r->at[SIG_QW] < 0 || r->at[SIG_QX] < 0 || r->at[SIG_QY] < 0 || r->at[SIG_QZ] < 0)
    quaternion_from_angles(row->v);
  const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (norm < 0.9 || norm > 1.1) {
    bad_cells_t *const bad = &r->bad[SIG_QW];
    if (bad->n++ == 0) *bad = (bad_cells_t){1, table_line(&r->table), norm, true};
    for (int i = 0; i < 4; i++) q[i] = GAP;
    return;
  }
  for (int i = 0; i < 4; i++) same += q[i] * r->last.v[SIG_QW + i];
  for (int i = 0; i < 4; i++) q[i] *= (r->any && same < 0.0 ? -1.0 : 1.0) / norm;
}

// World to body: a' = a + 2 u x (u x a + w a) with u the negative vector part.
static void acceleration_to_body(const log_rows_t *r, double *v) {
  if (r->columns.acc == ACC_BODY) return;
  if (r->columns.acc == ACC_WORLD) v[SIG_AZ] += G_MPS2;
  const double w = v[SIG_QW], x = -v[SIG_QX], y = -v[SIG_QY], z = -v[SIG_QZ];
  double *const a = &v[SIG_AX];
  const double t[3] = {y * a[2] - z * a[1] + w * a[0], z * a[0] - x * a[2] + w * a[1],
                       x * a[1] - y * a[0] + w * a[2]};
  a[0] += 2.0 * (y * t[2] - z * t[1]);
  a[1] += 2.0 * (z * t[0] - x * t[2]);
  a[2] += 2.0 * (x * t[1] - y * t[0]);
}

static done_t check_time(const log_rows_t *r, double now_s, why_t *why) {
  const double before_s = r->last.v[SIG_TIME];
  if (!r->any || now_s > before_s || (r->care == LOG_MEND && now_s >= before_s)) return DONE;
  return table_refuse(&r->table, 0, r->at[SIG_TIME], why,
                      "%.9g s after %.9g s; allowed: time that increases from row to row", now_s, before_s);
}

static done_t at_end(const log_rows_t *r, why_t *why) {
  char damage[480];
  if (r->care == LOG_STRICT && table_damage(&r->table, damage, sizeof damage))
    return error_set(why, "%s", damage);
  return DONE;
}

done_t log_rows_next(log_rows_t *r, log_row_t *row, bool *more, why_t *why) {
  TRY(table_next(&r->table, more, why));
  if (!*more) return at_end(r, why);
  TRY(read_signals(r, row, why));
  TRY(check_time(r, row->v[SIG_TIME], why));
  if (isnan(row->v[SIG_VBAT])) row->v[SIG_VBAT] = r->vbat_V;
  r->vbat_V = row->v[SIG_VBAT];
  read_attitude(r, row);
  acceleration_to_body(r, row->v);
  row->at_limit = log_motors_fill(&r->motors, &r->columns, &r->vehicle, row->v);
  // After a gap in the attitude the signs go on from the last quaternion.
  if (isnan(row->v[SIG_QW]))
    for (int i = SIG_TIME; i < SIG_QW; i++) r->last.v[i] = row->v[i];
  else
    r->last = *row;
  r->any = true;
  return DONE;
}
