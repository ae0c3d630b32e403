// columns.c - which column of a log is which of our signals.
#include "io/columns.h"

#include "io/toml.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define PI       3.14159265358979323846
#define UNIT_MAX 6

typedef enum { TIME, LENGTH, SPEED, ACCELERATION, NUMBER, ANGLE, RATE, MOTOR, FORCE, VOLTAGE, KINDS } kind_t;

typedef struct {
  const char *name;
  double si;
} unit_t;

// The first unit of a kind is ours. Motors: commands of 0..65535, or newton.
static const unit_t UNITS[KINDS][UNIT_MAX] = {
    [TIME] = {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}},
    [LENGTH] = {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}},
    [SPEED] = {{"m/s", 1.0}, {"cm/s", 1e-2}, {"mm/s", 1e-3}},
    [ACCELERATION] = {{"m/s2", 1.0}, {"g", 9.81}, {"mg", 9.81e-3}},
    [NUMBER] = {{"1", 1.0}},
    [ANGLE] = {{"rad", 1.0}, {"deg", PI / 180.0}},
    [RATE] = {{"rad/s", 1.0}, {"deg/s", PI / 180.0}},
    [MOTOR] = {{"pwm", 1.0}, {"percent", 655.35}, {"share", 65535.0}},
    [FORCE] = {{"N", 1.0}, {"mN", 1e-3}, {"gram", 9.81e-3}},
    [VOLTAGE] = {{"V", 1.0}, {"mV", 1e-3}},
};

// What no flight and no bench shows is refused.
static const struct {
  const char *name;
  kind_t kind;
  double min, max;       // SI
  const char *crazyflie; // its name and unit in a Crazyflie's log
  const char *unit;
} ROWS[SIG_COUNT] = {
    [SIG_TIME] = {"time", TIME, -1e12, 1e12, "timestamp", "ms"},
    [SIG_X] = {"x", LENGTH, -100.0, 100.0, "stateEstimate.x", "m"},
    [SIG_Y] = {"y", LENGTH, -100.0, 100.0, "stateEstimate.y", "m"},
    [SIG_Z] = {"z", LENGTH, -30.0, 100.0, "stateEstimate.z", "m"},
    [SIG_VX] = {"vx", SPEED, -30.0, 30.0, "stateEstimate.vx", "m/s"},
    [SIG_VY] = {"vy", SPEED, -30.0, 30.0, "stateEstimate.vy", "m/s"},
    [SIG_VZ] = {"vz", SPEED, -30.0, 30.0, "stateEstimate.vz", "m/s"},
    [SIG_AX] = {"ax", ACCELERATION, -240.0, 240.0, "acc.x", "g"},
    [SIG_AY] = {"ay", ACCELERATION, -240.0, 240.0, "acc.y", "g"},
    [SIG_AZ] = {"az", ACCELERATION, -240.0, 240.0, "acc.z", "g"},
    [SIG_QW] = {"qw", NUMBER, -1.1, 1.1, "stateEstimate.qw", "1"},
    [SIG_QX] = {"qx", NUMBER, -1.1, 1.1, "stateEstimate.qx", "1"},
    [SIG_QY] = {"qy", NUMBER, -1.1, 1.1, "stateEstimate.qy", "1"},
    [SIG_QZ] = {"qz", NUMBER, -1.1, 1.1, "stateEstimate.qz", "1"},
    [SIG_ROLL] = {"roll", ANGLE, -2.0 * PI, 2.0 * PI, "stateEstimate.roll", "deg"},
    [SIG_PITCH] = {"pitch", ANGLE, -2.0 * PI, 2.0 * PI, "stateEstimate.pitch", "deg"},
    [SIG_YAW] = {"yaw", ANGLE, -1e3, 1e3, "stateEstimate.yaw", "deg"},
    [SIG_GX] = {"gx", RATE, -70.0, 70.0, "gyro.x", "deg/s"},
    [SIG_GY] = {"gy", RATE, -70.0, 70.0, "gyro.y", "deg/s"},
    [SIG_GZ] = {"gz", RATE, -70.0, 70.0, "gyro.z", "deg/s"},
    [SIG_M1] = {"m1", MOTOR, 0.0, 65536.0, "motor.m1", "pwm"},
    [SIG_M2] = {"m2", MOTOR, 0.0, 65536.0, "motor.m2", "pwm"},
    [SIG_M3] = {"m3", MOTOR, 0.0, 65536.0, "motor.m3", "pwm"},
    [SIG_M4] = {"m4", MOTOR, 0.0, 65536.0, "motor.m4", "pwm"},
    [SIG_THRUST] = {"thrust", FORCE, -200.0, 200.0, "indi.thrust", "N"},
    [SIG_VBAT] = {"vbat", VOLTAGE, 1.0, 60.0, "pm.vbat", "V"},
    [SIG_RANGE] = {"range", LENGTH, 0.0, 40.0, "range.up", "mm"},
};

const char *columns_name(signal_id_t signal) {
  return ROWS[signal].name;
}
const char *columns_si(signal_id_t signal) {
  return UNITS[ROWS[signal].kind][0].name;
}

void columns_bounds(signal_id_t signal, double *min, double *max) {
  *min = ROWS[signal].min;
  *max = ROWS[signal].max;
}

static const unit_t *find_unit(kind_t kind, const char *name) {
  for (int i = 0; i < UNIT_MAX && UNITS[kind][i].name; i++)
    if (strcmp(UNITS[kind][i].name, name) == 0) return &UNITS[kind][i];
  return NULL;
}

const char *columns_unit_within(const columns_t *c, signal_id_t signal, double value, double min, double max,
                                double *factor) {
  const kind_t kind = ROWS[signal].kind;
  const unit_t *now = find_unit(kind, c->of[signal].unit);
  for (int i = 0; now && i < UNIT_MAX && UNITS[kind][i].name; i++) {
    *factor = UNITS[kind][i].si / now->si;
    if (value * *factor >= min && value * *factor <= max) return UNITS[kind][i].name;
  }
  return NULL;
}

columns_t columns_crazyflie(void) {
  columns_t c = {.acc = ACC_BODY, .rest_height_m = (double)NAN};
  for (int i = 0; i < SIG_COUNT; i++) {
    column_t *const to = &c.of[i];
    snprintf(to->column, sizeof to->column, "%s", ROWS[i].crazyflie);
    snprintf(to->unit, sizeof to->unit, "%s", ROWS[i].unit);
    to->factor = find_unit(ROWS[i].kind, ROWS[i].unit)->si;
    to->optional = i != SIG_TIME;
  }
  // The firmware's attitude.pitch is nose up positive; its quaternion is right-handed.
  c.of[SIG_PITCH].factor *= -1.0;
  return c;
}

static status_t read_unit(toml_t t, signal_id_t signal, columns_t *c, why_t *why) {
  column_t *const to = &c->of[signal];
  const kind_t kind = ROWS[signal].kind;
  TRY(toml_string(t, "unit", to->unit, sizeof to->unit, why));
  const unit_t *unit = find_unit(kind, to->unit);
  if (!unit && kind == MOTOR && (unit = find_unit(FORCE, to->unit))) c->motors_N = true;
  if (unit) {
    to->factor = unit->si;
    return ST_OK;
  }
  char list[80] = "";
  for (int i = 0; i < 2 * UNIT_MAX; i++) {
    const unit_t *u = i < UNIT_MAX ? &UNITS[kind][i] : &UNITS[FORCE][i - UNIT_MAX];
    if (!u->name || (i >= UNIT_MAX && kind != MOTOR)) continue;
    const size_t used = strlen(list);
    snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", u->name);
  }
  return toml_refuse(t, "unit", why, "unknown unit `%s` of %s; allowed: %s", to->unit, ROWS[signal].name,
                     list);
}

static status_t read_column(toml_t columns, signal_id_t signal, columns_t *c, why_t *why) {
  static const char *const keys[] = {"column", "unit", "scale", "offset", "optional", NULL};
  column_t *const to = &c->of[signal];
  double scale = 1.0;
  toml_t t;
  TRY(toml_table(columns, ROWS[signal].name, &t, why));
  TRY(toml_only(t, keys, why));
  TRY(toml_string(t, "column", to->column, sizeof to->column, why));
  TRY(read_unit(t, signal, c, why));
  if (toml_has(t, "scale")) TRY(toml_double(t, "scale", -1e9, 1e9, &scale, why));
  if (scale == 0.0) return toml_refuse(t, "scale", why, "0; allowed: any other number");
  if (toml_has(t, "offset")) TRY(toml_double(t, "offset", -1e12, 1e12, &to->offset, why));
  if (toml_has(t, "optional")) TRY(toml_bool(t, "optional", &to->optional, why));
  to->factor *= scale;
  return ST_OK;
}

static status_t read_frame(toml_t root, acc_frame_t *frame, why_t *why) {
  static const char *const names[] = {"body", "world", "world_with_gravity"};
  char name[32];
  TRY(toml_string(root, "acceleration", name, sizeof name, why));
  for (int i = 0; i < 3; i++) {
    if (strcmp(names[i], name) != 0) continue;
    *frame = (acc_frame_t)i;
    return ST_OK;
  }
  return toml_refuse(root, "acceleration", why,
                     "unknown frame `%s`; allowed: body, world, world_with_gravity", name);
}

static status_t read_columns(toml_t t, columns_t *c, why_t *why) {
  const char *keys[SIG_COUNT + 1] = {NULL};
  for (int i = 0; i < SIG_COUNT; i++) keys[i] = ROWS[i].name;
  TRY(toml_only(t, keys, why));
  for (int i = 0; i < SIG_COUNT; i++)
    if (i == SIG_TIME || toml_has(t, ROWS[i].name)) TRY(read_column(t, (signal_id_t)i, c, why));
  for (int i = SIG_M1; c->motors_N && i <= SIG_M4; i++)
    if (c->of[i].column[0] && find_unit(MOTOR, c->of[i].unit))
      return toml_refuse(t, ROWS[i].name, why, "a command beside motors in newton; allowed: one of both");
  return ST_OK;
}

static status_t read_root(toml_t root, columns_t *c, why_t *why) {
  static const char *const keys[] = {"rest_height_m", "acceleration", "columns", NULL};
  toml_t columns;
  TRY(toml_only(root, keys, why));
  TRY(toml_table(root, "columns", &columns, why));
  TRY(read_columns(columns, c, why));
  if (c->of[SIG_AX].column[0] || c->of[SIG_AZ].column[0]) TRY(read_frame(root, &c->acc, why));
  if (toml_has(root, "rest_height_m"))
    TRY(toml_double(root, "rest_height_m", -10.0, 10.0, &c->rest_height_m, why));
  return ST_OK;
}

status_t columns_read(const char *path, columns_t *c, why_t *why) {
  toml_file_t *file;
  TRY(toml_open(&file, path, why));
  columns_t fresh = {.acc = ACC_BODY, .rest_height_m = (double)NAN};
  const status_t status = read_root(toml_root(file), &fresh, why);
  toml_close(file);
  if (status == ST_OK) *c = fresh;
  return status;
}
