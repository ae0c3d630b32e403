// rows.c - the parameters and logs of the group `desk`.
#include "drone/rows.h"

#include "crazyflie/log.h"
#include "crazyflie/param.h"

#define PARAM(name, c_type, type, ...) {"desk", #name, type, offsetof(desk_params_t, name)},
#define LOG(name, c_type, type)        {"desk", #name, type, offsetof(desk_logs_t, name)},
#define RANGE(name, c_type, type, ...) {__VA_ARGS__},
const stock_row_t desk_param_rows[] = {DESK_PARAMS(PARAM)};
const stock_row_t desk_log_rows[] = {DESK_LOGS(LOG)};
const desk_range_t desk_ranges[] = {DESK_PARAMS(RANGE)};
const int desk_param_count = (int)(sizeof desk_param_rows / sizeof *desk_param_rows);
const int desk_log_count = (int)(sizeof desk_log_rows / sizeof *desk_log_rows);
