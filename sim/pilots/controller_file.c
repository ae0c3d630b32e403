// controller_file.c - the table [controller] of a vehicle file.
#include "pilots/controller_file.h"

#include "base/nearest.h"
#include "base/toml.h"
#include "flight/params.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define GAIN_MAX    1e5
#define RATE_MIN_HZ 10.0
#define RATE_MAX_HZ 10000.0
#define OVERHEAD    1.10 // factor on the firmware's velocity limits
#define CLIMB_MIN   0.5  // the firmware's smallest limit of climb, m/s

// --- the firmware's PID -----------------------------------------------------------------------------------

typedef struct {
  const char *group, *key;
  double max;    // from 0
  size_t offset; // in stock_pid_param_t
} gain_t;

#define AT(field) offsetof(stock_pid_param_t, field)
#define PID_OF(group, p, i, d, field)                                                                        \
  {group, p, GAIN_MAX, AT(field.kp)}, {group, i, GAIN_MAX, AT(field.ki)}, {                                  \
    group, d, GAIN_MAX, AT(field.kd)                                                                         \
  }

static const gain_t GAIN[] = {
    PID_OF("posCtlPid", "xKp", "xKi", "xKd", position.pos[0]),
    PID_OF("posCtlPid", "yKp", "yKi", "yKd", position.pos[1]),
    PID_OF("posCtlPid", "zKp", "zKi", "zKd", position.pos[2]),
    {"posCtlPid", "xVelMax", 100.0, AT(position.pos[0].output_max)},
    {"posCtlPid", "yVelMax", 100.0, AT(position.pos[1].output_max)},
    {"posCtlPid", "zVelMax", 100.0, AT(position.pos[2].output_max)},
    {"posCtlPid", "thrustBase", STOCK_FULL, AT(position.thrust_base)},
    {"posCtlPid", "thrustMin", STOCK_FULL, AT(position.thrust_min)},
    PID_OF("velCtlPid", "vxKp", "vxKi", "vxKd", position.vel[0]),
    PID_OF("velCtlPid", "vyKp", "vyKi", "vyKd", position.vel[1]),
    PID_OF("velCtlPid", "vzKp", "vzKi", "vzKd", position.vel[2]),
    PID_OF("pid_attitude", "roll_kp", "roll_ki", "roll_kd", attitude[0]),
    PID_OF("pid_attitude", "pitch_kp", "pitch_ki", "pitch_kd", attitude[1]),
    PID_OF("pid_attitude", "yaw_kp", "yaw_ki", "yaw_kd", attitude[2]),
    PID_OF("pid_rate", "roll_kp", "roll_ki", "roll_kd", rate[0]),
    PID_OF("pid_rate", "pitch_kp", "pitch_ki", "pitch_kd", rate[1]),
    PID_OF("pid_rate", "yaw_kp", "yaw_ki", "yaw_kd", rate[2]),
};
#define GAINS ((int)(sizeof GAIN / sizeof *GAIN))

static done_t read_gains(toml_t t, const char *group, stock_pid_param_t *p, why_t *why) {
  const char *keys[GAINS + 1] = {NULL};
  toml_t sub;
  int n = 0;
  if (!toml_has(t, group)) return DONE;
  TRY(toml_table(t, group, &sub, why));
  for (int i = 0; i < GAINS; i++)
    if (strcmp(GAIN[i].group, group) == 0) keys[n++] = GAIN[i].key;
  TRY(toml_only(sub, keys, why));
  for (int i = 0; i < GAINS; i++) {
    if (strcmp(GAIN[i].group, group) != 0 || !toml_has(sub, GAIN[i].key)) continue;
    double value;
    TRY(toml_double(sub, GAIN[i].key, 0.0, GAIN[i].max, &value, why));
    const bool speed = strstr(GAIN[i].key, "VelMax") != NULL;
    if (speed) value = OVERHEAD * (GAIN[i].key[0] == 'z' ? fmax(value, CLIMB_MIN) : value);
    if (speed && !(value > 0.0))
      return toml_refuse(sub, GAIN[i].key, why, "0; allowed: more than 0, to %g", GAIN[i].max);
    memcpy((char *)p + GAIN[i].offset, &value, sizeof value);
  }
  return DONE;
}

static done_t read_pid(toml_t t, const model_t *m, flown_by_t *by, why_t *why) {
  static const char *const keys[] = {"kind",         "full_scale_N", "posCtlPid", "velCtlPid",
                                     "pid_attitude", "pid_rate",     NULL};
  stock_pid_param_t pid = stock_pid_default();
  pid.power.thrust_max_N = m->thrust_max_N / PILOT_MOTORS;
  TRY(toml_only(t, keys, why));
  if (toml_has(t, "full_scale_N"))
    TRY(toml_double(t, "full_scale_N", 1e-4, 1e3, &pid.power.thrust_max_N, why));
  for (int i = 2; keys[i]; i++) TRY(read_gains(t, keys[i], &pid, why));
  *by = (flown_by_t){.kind = FLOWN_BY_STOCK_PID, .pid = pid};
  return DONE;
}

// --- our own flight code ----------------------------------------------------------------------------------

static done_t no_param(toml_t group, const char *key, const char *name, why_t *why) {
  char hint[NEAREST_HINT];
  nearest_t nearest = nearest_to(name);
  for (int i = 0; i < params_count; i++) nearest_try(&nearest, params_table[i].name);
  return toml_refuse(group, key, why, "unknown parameter%s; allowed: those of fly --params",
                     nearest_hint(&nearest, hint));
}

// Reads one parameter; `all` holds those read before it.
static done_t read_param(toml_t group, const char *key, const char *name, flown_by_t *by, flight_param_t *all,
                         why_t *why) {
  const param_row_t *const row = params_find(name);
  double value;
  if (!row) return no_param(group, key, name, why);
  if (by->n_set == FLOWN_BY_SETS)
    return toml_refuse(group, key, why, "one too many; allowed: %d parameters", FLOWN_BY_SETS);
  TRY(toml_double(group, key, (double)row->min, (double)row->max, &value, why));
  if (params_set(all, row, (float)value) != ST_OK)
    return toml_refuse(group, key, why, "%g; allowed: a whole number", value);
  flown_by_set_t *const to = &by->set[by->n_set++];
  snprintf(to->name, sizeof to->name, "%s", name);
  to->value = value;
  return DONE;
}

static done_t read_indi(toml_t t, flown_by_t *to, why_t *why) {
  static const char *const keys[] = {"kind", "indiPos", "indiAtt", "ceil", "rls", "guard", NULL};
  flown_by_t by = {.kind = FLOWN_BY_INDI};
  flight_param_t all;
  params_default(&all);
  TRY(toml_only(t, keys, why));
  for (int i = 1; keys[i]; i++) {
    toml_t group;
    const char *key;
    if (!toml_has(t, keys[i])) continue;
    TRY(toml_table(t, keys[i], &group, why));
    for (int k = 0; (key = toml_key(group, k)) != NULL; k++) {
      char name[sizeof by.set->name];
      if (snprintf(name, sizeof name, "%s.%s", keys[i], key) >= (int)sizeof name)
        return toml_refuse(group, key, why, "unknown parameter; allowed: those of fly --params");
      TRY(read_param(group, key, name, &by, &all, why));
    }
  }
  if (params_check(&all) != ST_OK)
    return toml_refuse(t, "kind", why,
                       "parameters that contradict each other; allowed: what fly --set takes together");
  *to = by;
  return DONE;
}

static done_t read_other(toml_t t, flown_by_t *to, why_t *why) {
  static const char *const keys[] = {"kind", "rate_Hz", NULL};
  flown_by_t by = {.kind = FLOWN_BY_OTHER};
  TRY(toml_only(t, keys, why));
  if (!toml_has(t, "rate_Hz"))
    return toml_refuse(t, "rate_Hz", why,
                       "missing; allowed: how often the controller commands the motors, %g to %g Hz",
                       RATE_MIN_HZ, RATE_MAX_HZ);
  TRY(toml_double(t, "rate_Hz", RATE_MIN_HZ, RATE_MAX_HZ, &by.rate_Hz, why));
  *to = by;
  return DONE;
}

static done_t read_table(toml_t root, const model_t *m, flown_by_t *by, why_t *why) {
  char kind[32];
  toml_t t;
  if (!toml_has(root, "controller")) return DONE;
  TRY(toml_table(root, "controller", &t, why));
  TRY(toml_string(t, "kind", kind, sizeof kind, why));
  if (strcmp(kind, "stock-pid") == 0) return read_pid(t, m, by, why);
  if (strcmp(kind, "indi") == 0) return read_indi(t, by, why);
  if (strcmp(kind, "other") == 0) return read_other(t, by, why);
  char hint[NEAREST_HINT];
  static const char *const kinds[] = {"stock-pid", "indi", "other", NULL};
  return toml_refuse(t, "kind", why, "unknown kind `%s`%s; allowed: stock-pid, indi, other", kind,
                     nearest_of(kind, kinds, hint));
}

done_t controller_read(const char *path, const char *text, const model_t *m, flown_by_t *by, why_t *why) {
  toml_file_t *file;
  *by = (flown_by_t){.kind = FLOWN_BY_UNKNOWN};
  TRY(text ? toml_open_text(&file, path, text, &model_file_kind, why)
           : toml_open(&file, path, &model_file_kind, why));
  const done_t done = read_table(toml_root(file), m, by, why);
  toml_close(file);
  return done;
}
