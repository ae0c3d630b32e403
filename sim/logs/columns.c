// columns.c - which column of a log is which of our signals.
#include "logs/columns.h"

#include "base/constants.h"
#include "base/text.h"
#include "base/toml.h"
#include "logs/units.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

// A value out of min..max is refused: no flight and no bench shows it. A range may be a little below 0: near
// a surface a sensor reads so if it is mounted higher than stated.
static const struct {
  const char *name;
  kind_t kind;
  double min, max;       // SI
  const char *crazyflie; // its name and unit in a Crazyflie's log
  const char *unit;
} ROWS[SIG_COLUMNS] = {
    [SIG_TIME] = {"time", KIND_TIME, -1e12, 1e12, "timestamp", "ms"},
    [SIG_X] = {"x", KIND_LENGTH, -100.0, 100.0, "stateEstimate.x", "m"},
    [SIG_Y] = {"y", KIND_LENGTH, -100.0, 100.0, "stateEstimate.y", "m"},
    [SIG_Z] = {"z", KIND_LENGTH, -30.0, 100.0, "stateEstimate.z", "m"},
    [SIG_VX] = {"vx", KIND_SPEED, -30.0, 30.0, "stateEstimate.vx", "m/s"},
    [SIG_VY] = {"vy", KIND_SPEED, -30.0, 30.0, "stateEstimate.vy", "m/s"},
    [SIG_VZ] = {"vz", KIND_SPEED, -30.0, 30.0, "stateEstimate.vz", "m/s"},
    [SIG_AX] = {"ax", KIND_ACCELERATION, -240.0, 240.0, "acc.x", "g"},
    [SIG_AY] = {"ay", KIND_ACCELERATION, -240.0, 240.0, "acc.y", "g"},
    [SIG_AZ] = {"az", KIND_ACCELERATION, -240.0, 240.0, "acc.z", "g"},
    [SIG_QW] = {"qw", KIND_NUMBER, -1.1, 1.1, "stateEstimate.qw", "1"},
    [SIG_QX] = {"qx", KIND_NUMBER, -1.1, 1.1, "stateEstimate.qx", "1"},
    [SIG_QY] = {"qy", KIND_NUMBER, -1.1, 1.1, "stateEstimate.qy", "1"},
    [SIG_QZ] = {"qz", KIND_NUMBER, -1.1, 1.1, "stateEstimate.qz", "1"},
    [SIG_ROLL] = {"roll", KIND_ANGLE, -2.0 * PI, 2.0 * PI, "stateEstimate.roll", "deg"},
    [SIG_PITCH] = {"pitch", KIND_ANGLE, -2.0 * PI, 2.0 * PI, "stateEstimate.pitch", "deg"},
    [SIG_YAW] = {"yaw", KIND_ANGLE, -1e3, 1e3, "stateEstimate.yaw", "deg"},
    [SIG_GX] = {"gx", KIND_RATE, -70.0, 70.0, "gyro.x", "deg/s"},
    [SIG_GY] = {"gy", KIND_RATE, -70.0, 70.0, "gyro.y", "deg/s"},
    [SIG_GZ] = {"gz", KIND_RATE, -70.0, 70.0, "gyro.z", "deg/s"},
    [SIG_M1] = {"m1", KIND_MOTOR, 0.0, 65536.0, "motor.m1", "pwm"},
    [SIG_M2] = {"m2", KIND_MOTOR, 0.0, 65536.0, "motor.m2", "pwm"},
    [SIG_M3] = {"m3", KIND_MOTOR, 0.0, 65536.0, "motor.m3", "pwm"},
    [SIG_M4] = {"m4", KIND_MOTOR, 0.0, 65536.0, "motor.m4", "pwm"},
    [SIG_THRUST] = {"thrust", KIND_FORCE, -200.0, 200.0, "indi.thrust", "N"},
    [SIG_VBAT] = {"vbat", KIND_VOLTAGE, 1.0, 60.0, "pm.vbat", "V"},
    [SIG_RANGE] = {"range", KIND_LENGTH, -0.1, 40.0, "range.up", "mm"},
    [SIG_RANGE_DOWN] = {"range_down", KIND_LENGTH, -0.1, 40.0, "range.zrange", "mm"},
    [SIG_TX] = {"tx", KIND_TORQUE, -50.0, 50.0, "", "Nm"},
    [SIG_TY] = {"ty", KIND_TORQUE, -50.0, 50.0, "", "Nm"},
    [SIG_TZ] = {"tz", KIND_TORQUE, -50.0, 50.0, "", "Nm"},
    [SIG_W1] = {"w1", KIND_SPIN, 0.0, 1e4, "rpm.m1", "rpm"},
    [SIG_W2] = {"w2", KIND_SPIN, 0.0, 1e4, "rpm.m2", "rpm"},
    [SIG_W3] = {"w3", KIND_SPIN, 0.0, 1e4, "rpm.m3", "rpm"},
    [SIG_W4] = {"w4", KIND_SPIN, 0.0, 1e4, "rpm.m4", "rpm"},
    [SIG_SET_X] = {"set_x", KIND_LENGTH, -1e4, 1e4, "ctrltarget.x", "m"},
    [SIG_SET_Y] = {"set_y", KIND_LENGTH, -1e4, 1e4, "ctrltarget.y", "m"},
    [SIG_SET_Z] = {"set_z", KIND_LENGTH, -1e4, 1e4, "ctrltarget.z", "m"},
    [SIG_SET_VX] = {"set_vx", KIND_SPEED, -1e4, 1e4, "ctrltarget.vx", "m/s"},
    [SIG_SET_VY] = {"set_vy", KIND_SPEED, -1e4, 1e4, "ctrltarget.vy", "m/s"},
    [SIG_SET_VZ] = {"set_vz", KIND_SPEED, -1e4, 1e4, "ctrltarget.vz", "m/s"},
    // The firmware's ctrltarget.yaw is the rate that is asked for, not the angle.
    [SIG_SET_YAW] = {"set_yaw", KIND_ANGLE, -1e3, 1e3, "", "deg"},
};

// Other kinds that a motor command may be of, and its bounds then.
static const struct {
  kind_t kind;
  double min, max;
} OTHER[] = {{KIND_SPIN, 0.0, 1e4}, {KIND_FORCE, -200.0, 200.0}, {KIND_MOTOR, -131072.0, 131072.0}};
#define OTHERS ((int)(sizeof OTHER / sizeof *OTHER))

const char *columns_name(signal_id_t signal) {
  return ROWS[signal].name;
}
// m1..m4 may also be newton or speeds, thrust and torques also pwm.
static bool may_be(signal_id_t signal, kind_t kind) {
  if (kind == ROWS[signal].kind) return true;
  if (signal >= SIG_M1 && signal <= SIG_M4) return kind == KIND_FORCE || kind == KIND_SPIN;
  return kind == KIND_MOTOR && (signal == SIG_THRUST || (signal >= SIG_TX && signal <= SIG_TZ));
}

// The kind of the unit that the log has.
static kind_t kind_of(const columns_t *c, signal_id_t signal) {
  for (int i = 0; i < OTHERS; i++)
    if (may_be(signal, OTHER[i].kind) && unit_find(OTHER[i].kind, c->of[signal].unit)) return OTHER[i].kind;
  return ROWS[signal].kind;
}

const char *columns_si(const columns_t *c, signal_id_t signal) {
  return unit_at(kind_of(c, signal), 0)->name;
}

void columns_bounds(const columns_t *c, signal_id_t signal, double *min, double *max) {
  const kind_t kind = kind_of(c, signal);
  *min = ROWS[signal].min;
  *max = ROWS[signal].max;
  for (int i = 0; i < OTHERS; i++) {
    if (kind == ROWS[signal].kind || kind != OTHER[i].kind) continue;
    *min = OTHER[i].min;
    *max = OTHER[i].max;
  }
}

const char *columns_hint(const columns_t *c, signal_id_t signal, double value, double min, double max,
                         char text[COLUMNS_HINT]) {
  const kind_t kind = kind_of(c, signal);
  const unit_t *const now = unit_find(kind, c->of[signal].unit), *unit;
  int n = 0;
  text[0] = '\0';
  for (int i = 0; now && (unit = unit_at(kind, i)) != NULL; i++) {
    const double factor = unit->si / now->si;
    if (!(value * factor >= min && value * factor <= max)) continue;
    text_add(text, COLUMNS_HINT, "%s %s would fit (factor %.4g)", n++ ? ", or" : "; the unit", unit->name,
             factor);
  }
  return text;
}

columns_t columns_crazyflie(void) {
  columns_t c = {.acc = ACC_BODY, .crazyflie = true, .rest_height_m = (double)NAN};
  for (int i = 0; i < SIG_COLUMNS; i++) {
    column_t *const to = &c.of[i];
    snprintf(to->column, sizeof to->column, "%s", ROWS[i].crazyflie);
    snprintf(to->unit, sizeof to->unit, "%s", ROWS[i].unit);
    to->factor = unit_find(ROWS[i].kind, ROWS[i].unit)->si;
    to->optional = i != SIG_TIME;
  }
  // The firmware's two-pole low-passes of 30 and 80 Hz: sqrt(2)/(2 pi f).
  for (int i = 0; i < 3; i++) {
    c.of[SIG_AX + i].late_s = 7.5e-3;
    c.of[SIG_GX + i].late_s = 2.8e-3;
  }
  // The Multi-ranger's task fetches samples that are 60 to 80 ms old; downward, 25 ms of exposure
  // (sense/range.h).
  c.of[SIG_RANGE].late_s = 70e-3;
  c.of[SIG_RANGE_DOWN].late_s = 13e-3;
  // The firmware's attitude.pitch is nose up positive; its quaternion is right-handed.
  c.of[SIG_PITCH].factor *= -1.0;
  return c;
}

// Other names in a Crazyflie's log: cfclient's name of the time, and variables that people log instead,
// packed or of another group.
static const struct {
  signal_id_t signal;
  const char *name, *unit;
  double scale;
} ALSO[] = {
    {SIG_TIME, "Timestamp", "ms", 1.0},
    {SIG_X, "stateEstimateZ.x", "mm", 1.0},
    {SIG_Y, "stateEstimateZ.y", "mm", 1.0},
    {SIG_Z, "stateEstimateZ.z", "mm", 1.0},
    {SIG_X, "kalman.stateX", "m", 1.0},
    {SIG_Y, "kalman.stateY", "m", 1.0},
    {SIG_Z, "kalman.stateZ", "m", 1.0},
    {SIG_VX, "stateEstimateZ.vx", "mm/s", 1.0},
    {SIG_VY, "stateEstimateZ.vy", "mm/s", 1.0},
    {SIG_VZ, "stateEstimateZ.vz", "mm/s", 1.0},
    {SIG_QW, "kalman.q0", "1", 1.0},
    {SIG_QX, "kalman.q1", "1", 1.0},
    {SIG_QY, "kalman.q2", "1", 1.0},
    {SIG_QZ, "kalman.q3", "1", 1.0},
    {SIG_ROLL, "stabilizer.roll", "deg", 1.0},
    {SIG_PITCH, "stabilizer.pitch", "deg", -1.0},
    {SIG_YAW, "stabilizer.yaw", "deg", 1.0},
    {SIG_VBAT, "pm.vbatMV", "mV", 1.0},
};
#define ALSO_ALL ((int)(sizeof ALSO / sizeof *ALSO))

bool columns_also(signal_id_t signal, int i, column_t *column) {
  for (int k = 0; k < ALSO_ALL; k++) {
    if (ALSO[k].signal != signal || i-- > 0) continue;
    snprintf(column->column, sizeof column->column, "%s", ALSO[k].name);
    snprintf(column->unit, sizeof column->unit, "%s", ALSO[k].unit);
    column->factor = ALSO[k].scale * unit_find(ROWS[signal].kind, ALSO[k].unit)->si;
    return true;
  }
  return false;
}

static done_t read_unit(toml_t t, signal_id_t signal, columns_t *c, why_t *why) {
  column_t *const to = &c->of[signal];
  TRY(toml_string(t, "unit", to->unit, sizeof to->unit, why));
  char list[120] = "";
  for (int kind = 0; kind < KIND_COUNT; kind++) {
    if (!may_be(signal, (kind_t)kind)) continue;
    const unit_t *const unit = unit_find((kind_t)kind, to->unit);
    if (unit) {
      to->factor = unit->si;
      return DONE;
    }
    unit_list((kind_t)kind, list, sizeof list);
  }
  return toml_refuse(t, "unit", why, "unknown unit `%s` of %s; allowed: %s", to->unit, ROWS[signal].name,
                     list);
}

static done_t read_constant(toml_t t, signal_id_t signal, columns_t *c, why_t *why) {
  static const char *const keys[] = {"value", "unit", NULL};
  column_t *const to = &c->of[signal];
  TRY(toml_only(t, keys, why));
  TRY(read_unit(t, signal, c, why));
  TRY(toml_double(t, "value", ROWS[signal].min / to->factor, ROWS[signal].max / to->factor, &to->offset,
                  why));
  to->offset *= to->factor;
  to->constant = true;
  return DONE;
}

static done_t read_column(toml_t columns, signal_id_t signal, columns_t *c, why_t *why) {
  static const char *const keys[] = {"column", "unit", "scale", "offset", "late_ms", "optional", NULL};
  column_t *const to = &c->of[signal];
  double scale = 1.0;
  toml_t t;
  TRY(toml_table(columns, ROWS[signal].name, &t, why));
  if (signal == SIG_VBAT && toml_has(t, "value")) return read_constant(t, signal, c, why);
  TRY(toml_only(t, keys, why));
  TRY(toml_string(t, "column", to->column, sizeof to->column, why));
  TRY(read_unit(t, signal, c, why));
  if (toml_has(t, "scale")) TRY(toml_double(t, "scale", -1e9, 1e9, &scale, why));
  if (scale == 0.0) return toml_refuse(t, "scale", why, "0; allowed: any other number");
  if (toml_has(t, "offset")) TRY(toml_double(t, "offset", -1e12, 1e12, &to->offset, why));
  double late_ms = 0.0;
  if (toml_has(t, "late_ms")) TRY(toml_double(t, "late_ms", -100.0, 100.0, &late_ms, why));
  to->late_s = 1e-3 * late_ms;
  to->late_said = toml_has(t, "late_ms");
  if (toml_has(t, "optional")) TRY(toml_bool(t, "optional", &to->optional, why));
  to->factor *= scale;
  return DONE;
}

static done_t read_frame(toml_t root, acc_frame_t *frame, why_t *why) {
  static const char *const names[] = {"body", "world", "world_with_gravity"};
  char name[32];
  TRY(toml_string(root, "acceleration", name, sizeof name, why));
  for (int i = 0; i < 3; i++) {
    if (strcmp(names[i], name) != 0) continue;
    *frame = (acc_frame_t)i;
    return DONE;
  }
  return toml_refuse(root, "acceleration", why,
                     "unknown frame `%s`; allowed: body, world, world_with_gravity", name);
}

static done_t read_rows(toml_t root, bool *means, why_t *why) {
  char word[32];
  TRY(toml_string(root, "rows", word, sizeof word, why));
  *means = strcmp(word, "means") == 0;
  if (*means || strcmp(word, "instants") == 0) return DONE;
  return toml_refuse(root, "rows", why, "unknown word `%s`; allowed: instants, means", word);
}

// Refuses motor commands that are not all of one kind, and notes which kind they are of.
static done_t read_kinds(toml_t t, columns_t *c, why_t *why) {
  static const struct {
    signal_id_t signal[4];
    kind_t kind[4]; // that go together; else all must be of one kind
  } group[] = {{{SIG_M1, SIG_M2, SIG_M3, SIG_M4}, {KIND_MOTOR, KIND_MOTOR, KIND_MOTOR, KIND_MOTOR}},
               {{SIG_THRUST, SIG_TX, SIG_TY, SIG_TZ}, {KIND_FORCE, KIND_TORQUE, KIND_TORQUE, KIND_TORQUE}}};
  for (int g = 0; g < 2; g++) {
    kind_t first = KIND_COUNT;
    for (int i = 0; i < 4; i++) {
      const signal_id_t s = group[g].signal[i];
      if (!c->of[s].column[0]) continue;
      const kind_t own = kind_of(c, s), kind = own == group[g].kind[i] ? group[g].kind[0] : own;
      if (first == KIND_COUNT) first = kind;
      if (kind != first)
        return toml_refuse(t, ROWS[s].name, why, "a command in %s beside one in %s; allowed: all of one kind",
                           unit_at(own, 0)->name, unit_at(first, 0)->name);
    }
    if (g == 0) c->motors = first == KIND_SPIN ? MOTORS_RADPS : first == KIND_FORCE ? MOTORS_N : MOTORS_PWM;
    if (g == 1) c->mixed_pwm = first == KIND_MOTOR;
  }
  return DONE;
}

// Refuses a part of the four motors: it says nothing of the vehicle.
static done_t check_motors(toml_t t, const columns_t *c, why_t *why) {
  for (int first = SIG_M1; first <= SIG_W1; first += SIG_W1 - SIG_M1) {
    int lacks = -1, there = -1;
    for (int i = first + 3; i >= first; i--) *(c->of[i].column[0] ? &there : &lacks) = i;
    if (there >= 0 && lacks >= 0)
      return toml_refuse(t, ROWS[there].name, why, "without %s; allowed: %s to %s, or none of them",
                         ROWS[lacks].name, ROWS[first].name, ROWS[first + 3].name);
  }
  return DONE;
}

static done_t read_columns(toml_t t, columns_t *c, why_t *why) {
  const char *keys[SIG_COLUMNS + 1] = {NULL};
  for (int i = 0; i < SIG_COLUMNS; i++) keys[i] = ROWS[i].name;
  TRY(toml_only(t, keys, why));
  for (int i = 0; i < SIG_COLUMNS; i++)
    if (i == SIG_TIME || toml_has(t, ROWS[i].name)) TRY(read_column(t, (signal_id_t)i, c, why));
  TRY(read_kinds(t, c, why));
  return check_motors(t, c, why);
}

static const char *const ROOT_KEYS[] = {"rest_height_m", "acceleration", "rows", "columns", NULL};
static const toml_kind_t COLUMNS_FILE = {"a columns file", "tools/columns/fly.toml", ROOT_KEYS};

// Without a table of columns the file's other keys apply to the Crazyflie's own columns.
static done_t read_root(toml_t root, columns_t *c, why_t *why) {
  toml_t columns;
  TRY(toml_only(root, ROOT_KEYS, why));
  if (toml_has(root, "columns") || !toml_key(root, 0)) {
    TRY(toml_table(root, "columns", &columns, why));
    TRY(read_columns(columns, c, why));
    if (c->of[SIG_AX].column[0] || c->of[SIG_AZ].column[0]) TRY(read_frame(root, &c->acc, why));
  } else {
    *c = columns_crazyflie();
    if (toml_has(root, "acceleration")) TRY(read_frame(root, &c->acc, why));
  }
  if (toml_has(root, "rows")) TRY(read_rows(root, &c->rows_are_means, why));
  if (toml_has(root, "rest_height_m"))
    TRY(toml_double(root, "rest_height_m", -10.0, 10.0, &c->rest_height_m, why));
  return DONE;
}

done_t columns_read(const char *path, columns_t *c, why_t *why) {
  toml_file_t *file;
  TRY(toml_open(&file, path, &COLUMNS_FILE, why));
  columns_t fresh = {.acc = ACC_BODY, .rest_height_m = (double)NAN};
  const done_t status = read_root(toml_root(file), &fresh, why);
  toml_close(file);
  if (status == DONE) *c = fresh;
  return status;
}
