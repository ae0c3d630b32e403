// rows.c - the parameters and logs of the group `desk`.
#include "drone/rows.h"

#include "crazyflie/log.h"
#include "crazyflie/param.h"
#include <math.h>
#include <string.h>

#define PARAM(name, c_type, type, ...) {"desk", #name, type, offsetof(desk_params_t, name)},
#define LOG(name, c_type, type)        {"desk", #name, type, offsetof(desk_logs_t, name)},
#define RANGE(name, c_type, type, ...) {__VA_ARGS__},
const stock_row_t desk_param_rows[] = {DESK_PARAMS(PARAM)};
const stock_row_t desk_log_rows[] = {DESK_LOGS(LOG)};
const desk_range_t desk_ranges[] = {DESK_PARAMS(RANGE)};
const int desk_param_count = (int)(sizeof desk_param_rows / sizeof *desk_param_rows);
const int desk_log_count = (int)(sizeof desk_log_rows / sizeof *desk_log_rows);

int desk_param_find(const char *name) {
  for (int i = 0; i < desk_param_count; i++)
    if (strcmp(desk_param_rows[i].name, name) == 0) return i;
  return -1;
}

done_t desk_param_check(const char *name, double value, why_t *why) {
  const int i = desk_param_find(name);
  if (i < 0) return error_set(why, "%s: there is no such parameter in the group desk", name);
  const desk_range_t *const r = &desk_ranges[i];
  const bool whole = desk_param_rows[i].type != PARAM_FLOAT;
  if (value >= r->min && value <= r->max && (!whole || value == floor(value))) return DONE;
  return error_set(why, "desk.%s: allowed is a %snumber from %g to %g%s%s", name, whole ? "whole " : "",
                   r->min, r->max, r->unit[0] ? " " : "", r->unit);
}
