// read.c - stage 1: turns a log into a flight.
#include "gap/1_read/read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SKEW_SPAN_S  300.0 // delays are estimated from this much of a flight
#define SKEW_MIN_S   0.0005
#define SKEW_MAX_S   0.04 // the firmware's estimate of velocity is 15 to 30 ms behind
#define SKEW_SURE    3.0  // standard errors
#define SKEW_ROUNDS  3
#define RANGE_SELDOM 0.7 // if fewer of the rows have a new sample, the sensor has a period of its own

// An attitude that is logged as angles.
static const signals_t ANGLES = SIGNALS(SIG_ROLL, SIG_YAW);

// Signals that are useful only together: three parts of a quaternion are no attitude, three motors carry no
// vehicle.
static const signals_t WHOLE[] = {ATTITUDE, COMMANDS, SIGNALS(SIG_F1, SIG_F4), SPEEDS};

void gap_flight_free(gap_flight_t *f) {
  for (int i = 0; i < SIG_COUNT; i++) free(f->v[i]);
  free(f->t_s);
  free(f->segment);
  free(f->saturated);
  *f = (gap_flight_t){0};
}

// --- the rows ----------------------------------------------------------------------------------------------

static bool all_gaps(const raw_t *raw, const double *v) {
  for (int i = 0; i < raw->n; i++)
    if (!isnan(v[i])) return false;
  return true;
}

// Drops the group unless all of it is there, and notes which signal is missing.
static void drop_part(gap_flight_t *f, raw_t *raw, signals_t group) {
  const bool whole = has(raw->v, group);
  const char *lacks = NULL, *there = NULL;
  for (int i = 0; i < SIG_COUNT; i++) {
    if (!(group & SIGNAL_BIT(i))) continue;
    const char *const name = i < SIG_COLUMNS ? columns_name((signal_id_t)i) : NULL;
    if (raw->v[i] && !there) there = name;
    if (!raw->v[i] && !lacks) lacks = name;
    if (!whole) raw_drop(raw, (signal_id_t)i);
  }
  if (!there || !lacks) return;
  gap_note(f, "no %s: %s and the others beside it are not used", lacks, there);
  if (!(group & (ATTITUDE | ANGLES))) f->motor_lacks = lacks;
}

// Drops columns that are no signals of a flight: angles (converted to a quaternion), torques (converted to
// thrusts), columns without any value, and incomplete groups. BAD_INPUT: the log has no signal of a flight.
static done_t drop_rest(gap_flight_t *f, raw_t *raw, const log_rows_t *rows, why_t *why) {
  bool any = false;
  if (!has(raw->v, ATTITUDE)) drop_part(f, raw, ANGLES);
  for (int i = 0; i < SIG_COUNT; i++) {
    const bool angle = i >= SIG_ROLL && i <= SIG_YAW, torque = i >= SIG_TX && i <= SIG_TZ;
    if (raw->v[i] && (i == SIG_TIME || angle || torque || all_gaps(raw, raw->v[i])))
      raw_drop(raw, (signal_id_t)i);
    any = any || raw->v[i];
  }
  if (!any)
    return table_refuse(&rows->table, 1, -1, why,
                        "no signal of a flight; allowed: columns of --columns FILE");
  for (unsigned k = 0; k < sizeof WHOLE / sizeof *WHOLE; k++) drop_part(f, raw, WHOLE[k]);
  return DONE;
}

// --- the streams' times -----------------------------------------------------------------------------------

static void add_shift(double shift_s[SIG_COUNT], signals_t signals, double late_s) {
  for (int i = 0; i < SIG_COUNT; i++)
    if (signals & SIGNAL_BIT(i)) shift_s[i] += late_s;
}

// Estimates the stream's delay beyond shift_s in rounds, each of the delay that the one before has left.
static done_t tell_late(raw_t *raw, const drive_t *stream, const double shift_s[SIG_COUNT], skew_t *told,
                        why_t *why) {
  *told = (skew_t){0.0, HUGE_VAL};
  for (int round = 0; round < SKEW_ROUNDS; round++) {
    gap_flight_t part = {0};
    double moved_s[SIG_COUNT];
    memcpy(moved_s, shift_s, sizeof moved_s);
    add_shift(moved_s, stream->late, told->late_s);
    const done_t status = gap_grid(&part, raw, stream->need, moved_s, SKEW_SPAN_S, false, why);
    const skew_t rest = status == DONE ? gap_skew(&part, stream) : *told;
    gap_flight_free(&part);
    TRY(status);
    told->late_s += rest.late_s;
    told->stderr_s = rest.stderr_s;
    if (!(fabs(told->late_s) <= SKEW_MAX_S) || !isfinite(rest.stderr_s)) break;
  }
  return DONE;
}

// True if the columns file gives a delay, which then stands: feedback of noise can look like a late stream.
// For an attitude that is logged as angles, one of the angles has it.
static bool is_said(const columns_t *c, signals_t moved) {
  if (moved == ATTITUDE) moved |= ANGLES;
  for (int i = 0; i < SIG_COUNT; i++)
    if ((moved & SIGNAL_BIT(i)) && c->of[i].late_said) return true;
  return false;
}

// Adds the stream's estimated delay to shift_s, if it is significant, plausible and at most most_s.
static done_t align(gap_flight_t *f, raw_t *raw, const columns_t *c, const drive_t *stream, double most_s,
                    double shift_s[SIG_COUNT], double *late_s, why_t *why) {
  skew_t told;
  if (!has(raw->v, stream->need) || is_said(c, stream->late)) return DONE;
  TRY(tell_late(raw, stream, shift_s, &told, why));
  const double size_s = fabs(told.late_s);
  if (!isfinite(told.stderr_s) || !(size_s > SKEW_SURE * told.stderr_s) || told.late_s > most_s) return DONE;
  if (!(size_s <= SKEW_MAX_S))
    gap_note(f, "the %s seems %.0f ms late against the %s: more than can be mended", stream->what,
             1e3 * told.late_s, stream->by);
  if (!(size_s >= SKEW_MIN_S && size_s <= SKEW_MAX_S)) return DONE;
  gap_note(f, "the %s was %.1f +- %.1f ms late against the %s; it is moved by as much", stream->what,
           1e3 * told.late_s, 1e3 * told.stderr_s, stream->by);
  *late_s = told.late_s;
  add_shift(shift_s, stream->late, told.late_s);
  return DONE;
}

// --- the whole --------------------------------------------------------------------------------------------

// Notes what the log lacks, and what that costs.
static void note_missing(gap_flight_t *f) {
  const struct {
    signals_t need;
    const char *what, *cost;
  } row[] = {
      {FORCE, "acceleration",
       f->v[SIG_VX] && f->v[SIG_QW]
           ? "that of the velocity stands in for it; its own errors are not looked for"
           : "(or velocity and attitude) no force is compared"},
      {GYRO, "rates", "no moment is compared"},
      {ATTITUDE, "attitude", "neither wind nor anything else in the world's axes is looked for"},
      {VELOCITY, "velocity",
       f->v[SIG_X] ? "that of the place stands in for it"
                   : "no drag, flapping, inflow and translational lift are looked for"},
      {PLACE, "place", "no ceiling, ground and wall are looked for"},
      {SIGNAL_BIT(SIG_VBAT), "voltage", "battery_sag is not looked for"},
  };
  for (unsigned k = 0; k < sizeof row / sizeof *row; k++)
    if (!has(f->v, row[k].need)) gap_note(f, "without %s %s", row[k].what, row[k].cost);
}

// Notes a vehicle that is tilted by more than 90 degrees to the end: after a fall it lies there, but no loop
// ends so. Missing samples are ignored.
static void note_fallen(gap_flight_t *f) {
  if (!has(f->v, ATTITUDE)) return;
  const double *const x = f->v[SIG_QX], *const y = f->v[SIG_QY];
  int from = f->n;
  for (int i = f->n - 1; i >= 0 && !(x[i] * x[i] + y[i] * y[i] <= 0.5); i--)
    if (!isnan(x[i] + y[i])) from = i;
  if (from < f->n)
    gap_note(f,
             "from %.2f s on it is tilted by more than 90 degrees, to the end: if it fell, cut the rows off, "
             "for a vehicle on the ground does not fly",
             f->t_s[from]);
}

static void note_samples(gap_flight_t *f) {
  int masked = 0;
  for (int i = 0; i < f->n; i++) masked += f->saturated[i];
  if (masked)
    gap_note(f, "a motor was at its limit in %.3g %% of the samples; they are masked", 100.0 * masked / f->n);
  if (f->n > 0 && f->segment[f->n - 1] > 0)
    gap_note(f, "gaps in time split the flight: %d", f->segment[f->n - 1]);
  note_fallen(f);
  note_missing(f);
}

// Fills shift_s with the delays that the columns file gives. Signals that are computed from commands or
// angles are as late as these.
static void late_as_logged(const log_rows_t *rows, double shift_s[SIG_COUNT]) {
  const column_t *const of = rows->columns.of;
  const bool each = rows->motors.kind == LOG_MOTORS_EACH || rows->motors.kind == LOG_MOTORS_MAP;
  double late_s = 0.0;
  for (int i = 0; i < SIG_COLUMNS; i++) shift_s[i] = of[i].late_s;
  for (int i = SIG_QW; i <= SIG_QZ && rows->at[SIG_QW] < 0; i++) shift_s[i] = of[SIG_ROLL].late_s;
  for (int i = 0; i < ROTORS; i++) {
    const signal_id_t m = each ? (signal_id_t)(SIG_M1 + i) : SIG_THRUST;
    shift_s[SIG_F1 + i] = of[m].late_s;
    late_s += of[m].late_s / ROTORS;
    if (!each) shift_s[SIG_M1 + i] = of[m].late_s; // computed from a mix
  }
  if (!rows->motors.total_logged) shift_s[SIG_THRUST] = late_s;
}

// Returns the age of a new sample of a range sensor when its row is written: by the columns file, else the
// vehicle file, else that of the Crazyflie's. A sensor slower than the log adds half a period of the log, its
// mean wait for the row. A block file of its own adds the mean wait for the row of the motors' file, and its
// own period takes the place of the log's. Rows that are means need no half period.
static double range_age_s(const raw_t *raw, const log_rows_t *rows, signal_id_t range) {
  const column_t *const column = &rows->columns.of[range];
  const range_told_t *const told = range == SIG_RANGE ? &rows->vehicle.range_up : &rows->vehicle.range_down;
  const double age_s = told->told && !column->late_said ? told->age_s : column->late_s;
  int fresh = 0;
  for (int i = 0; raw->v[range] && i < raw->n; i++) fresh += !isnan(raw->v[range][i]);
  const bool seldom = fresh < RANGE_SELDOM * raw->n;
  const blocks_times_t own = table_times(&rows->table, rows->at[range]);
  const double apart_s = fmax(own.apart_s, raw->period_s);
  return age_s + own.late_s + (seldom && !rows->columns.rows_are_means ? 0.5 * apart_s : 0.0);
}

static done_t make(gap_flight_t *f, raw_t *raw, log_rows_t *rows, why_t *why) {
  double shift_s[SIG_COUNT];
  late_as_logged(rows, shift_s);
  TRY(raw_read(raw, rows, &f->cut, why));
  if (rows->columns.acc != ACC_BODY) raw_to_world(raw);
  for (int i = SIG_RANGE; i <= SIG_RANGE_DOWN; i++) shift_s[i] = range_age_s(raw, rows, (signal_id_t)i);
  f->rows_are_means = rows->columns.rows_are_means || raw->thin > 1;
  TRY(gap_check_cells(f, raw, rows, why));
  TRY(raw_check_stuck(raw, rows, why));
  TRY(drop_rest(f, raw, rows, why));
  TRY(raw_from_floor(f, raw, rows, why));
  int slow;
  TRY(raw_free_of_repeats(raw, &slow, why));
  if (slow)
    gap_note(
        f,
        "streams that are slower than the log and repeat themselves: %d; they are drawn through their new "
        "values",
        slow);
  TRY(align(f, raw, &rows->columns, &GAP_TURN, HUGE_VAL, shift_s, &f->attitude_late_s, why));
  TRY(align(f, raw, &rows->columns, &GAP_PUSH, HUGE_VAL, shift_s, &f->velocity_late_s, why));
  // The position was moved with the velocity, but a filter that tracks the position delays it less: it is
  // moved back. Where the velocity was not moved, the velocity may be the one that is late.
  if (f->velocity_late_s > 0.0)
    TRY(align(f, raw, &rows->columns, &GAP_GO, 0.0, shift_s, &f->position_late_s, why));
  TRY(gap_grid(f, raw, ~(signals_t)0, shift_s, HUGE_VAL, true, why));
  if (f->n < 10)
    return table_refuse(&rows->table, 0, -1, why,
                        "%d samples without a gap; allowed: a second of flight or more", f->n);
  note_samples(f);
  return gap_check(f, rows, why);
}

done_t gap_read(gap_flight_t *f, const char *path, const columns_t *columns, const model_t *vehicle,
                why_t *why) {
  log_rows_t rows;
  raw_t raw = {0};
  *f = (gap_flight_t){0};
  TRY(log_rows_open(&rows, path, columns, vehicle, LOG_MEND, 0, why));
  snprintf(f->name, sizeof f->name, "%s", path);
  const done_t status = make(f, &raw, &rows, why);
  raw_free(&raw);
  log_rows_close(&rows);
  if (status != DONE) gap_flight_free(f);
  return status;
}
