// firmware_rows.c - the parameters and logs of a firmware by number: the stock firmware's own, the app's, and
// the simulation's.
#include "firmware.h"

#include "sections.h"
#include "values.h"
#include <string.h>

// What has a number: a row of a table, or a parameter or log of the app.
typedef struct {
  const stock_row_t *row; // null: one of the app's, as follows
  const section_param_t *param;
  const section_log_t *log;
  const char *group;
  void *at;
} place_t;

int firmware_params(const firmware_t *f) {
  return stock_param_count + sections_params() + (f->more ? f->more->n_param : 0);
}
int firmware_logs(const firmware_t *f) {
  return stock_log_count + sections_logs() + (f->more ? f->more->n_log : 0);
}

static void *app_at(const firmware_t *f, const void *address) {
  return stand_in_own(&f->vehicle.around, address);
}

static place_t param_place(const firmware_t *f, int i) {
  place_t p = {.row = NULL};
  const int app = i - stock_param_count, more = app - sections_params();
  if (app < 0) {
    p.row = &stock_param_rows[i];
    p.at = (char *)&f->params + p.row->offset;
  } else if (more < 0) {
    p.param = sections_param_at(app, &p.group);
    p.at = app_at(f, p.param->address);
  } else {
    p.row = &f->more->param[more];
    p.at = (char *)f->more->params(f->more_context) + p.row->offset;
  }
  return p;
}

static place_t log_place(const firmware_t *f, int i) {
  place_t p = {.row = NULL};
  const int app = i - stock_log_count, more = app - sections_logs();
  if (app < 0) {
    p.row = &stock_log_rows[i];
    p.at = (char *)&f->logs + p.row->offset;
  } else if (more < 0) {
    p.log = sections_log_in(app, &p.group);
    p.at = app_at(f, p.log->address);
  } else {
    p.row = &f->more->log[more];
    p.at = (char *)f->more->logs(f->more_context) + p.row->offset;
  }
  return p;
}

firmware_row_t firmware_param_row(const firmware_t *f, int i) {
  const place_t p = param_place(f, i);
  if (p.row) return (firmware_row_t){p.row->group, p.row->name, p.row->type};
  return (firmware_row_t){p.group, p.param->name, p.param->type};
}

firmware_row_t firmware_log_row(const firmware_t *f, int i) {
  const place_t p = log_place(f, i);
  if (p.row) return (firmware_row_t){p.row->group, p.row->name, p.row->type};
  return (firmware_row_t){p.group, p.log->name, p.log->type};
}

static int find(const firmware_t *f, const char *full_name, int n,
                firmware_row_t (*row_of)(const firmware_t *, int)) {
  for (int i = 0; i < n; i++) {
    const firmware_row_t row = row_of(f, i);
    const size_t size = strlen(row.group);
    if (strncmp(full_name, row.group, size) == 0 && full_name[size] == '.' &&
        strcmp(full_name + size + 1, row.name) == 0)
      return i;
  }
  return -1;
}

int firmware_param_find(const firmware_t *f, const char *full_name) {
  return find(f, full_name, firmware_params(f), firmware_param_row);
}
int firmware_log_find(const firmware_t *f, const char *full_name) {
  return find(f, full_name, firmware_logs(f), firmware_log_row);
}

double firmware_param(const firmware_t *f, int i) {
  return values_of_param(firmware_param_row(f, i).type, param_place(f, i).at);
}

double firmware_log(const firmware_t *f, int i) {
  return values_of_log(firmware_log_row(f, i).type, log_place(f, i).at);
}

double firmware_param_default(const firmware_t *f, int i) {
  const place_t p = param_place(f, i);
  const int more = i - stock_param_count - sections_params();
  if (more >= 0) return f->more->param_default[more];
  const char *const from = p.param ? (const char *)&f->vehicle.app : (const char *)&f->params;
  const char *const as_built = p.param ? (const char *)&f->app_default : (const char *)&f->params_default;
  return values_of_param(firmware_param_row(f, i).type, as_built + ((const char *)p.at - from));
}

// Hands the stock parameters to the modules that use them.
static void take_params(firmware_t *f) {
  const stock_params_t *const p = &f->params;
  f->commanded.planner.param =
      (planner_param_t){p->hlCommander_vtoff, p->hlCommander_vland, p->hlCommander_groupmask};
  f->commanded.pad = (pad_param_t){.alt_hold = p->flightmode_althold,
                                   .pos_hold = p->flightmode_poshold,
                                   .pos_set = p->flightmode_posSet,
                                   .angle_roll = p->flightmode_stabModeRoll,
                                   .angle_pitch = p->flightmode_stabModePitch,
                                   .angle_yaw = p->flightmode_stabModeYaw};
  stock_params_take_gains(p, &f->vehicle.stock.param);
}

void firmware_param_put(firmware_t *f, int i, double value) {
  const place_t p = param_place(f, i);
  values_put(firmware_param_row(f, i).type, p.at, value);
  take_params(f);
}

void firmware_param_set(firmware_t *f, int i, double value) {
  stand_in = &f->vehicle.around;
  firmware_param_put(f, i, value);
  const place_t p = param_place(f, i);
  const int more = i - stock_param_count - sections_params();
  if (p.param && p.param->callback) p.param->callback();
  if (more >= 0) f->more->written(f->more_context, more);
}
