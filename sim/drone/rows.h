// rows.h - the group `desk`: parameters by which a person at a client or at the page disturbs a vehicle that
// flies at the desk, and logs of what no real vehicle could tell.
#ifndef SIM_DRONE_ROWS_H
#define SIM_DRONE_ROWS_H

#include "base/error.h"
#include "crazyflie/stock_table.h"
#include <stdbool.h>

// X(name, C type, type, initial value, minimum, maximum, whether it is a switch, unit, what it does)
#define DESK_PARAMS(X)                                                                                       \
  X(ceiling, float, PARAM_FLOAT, 1.5, 0.15, 10, false, "m", "height of the ceiling; 10: none")               \
  X(cover, uint8_t, PARAM_UINT8, 0, 0, 1, true, "", "cover the upward range sensor")                         \
  X(hand, uint8_t, PARAM_UINT8, 0, 0, 4, false, "", "hand 10 cm off: 1 front, 2 back, 3 left, 4 right")      \
  X(windX, float, PARAM_FLOAT, 0, -100, 100, false, "mN", "push along x")                                    \
  X(windY, float, PARAM_FLOAT, 0, -100, 100, false, "mN", "push along y")                                    \
  X(windZ, float, PARAM_FLOAT, 0, -100, 100, false, "mN", "push upwards")                                    \
  X(payload, float, PARAM_FLOAT, 0, 0, 15, false, "g", "hang on a weight (its force alone)")                 \
  X(weakMotor, uint8_t, PARAM_UINT8, 0, 0, 4, false, "", "motor that is weak; 0: none")                      \
  X(weakBy, float, PARAM_FLOAT, 0.2, 0, 1, false, "", "share of its thrust that is lost")                    \
  X(battery, float, PARAM_FLOAT, 1, 0.01, 1, false, "", "charge of the battery")                             \
  X(loss, float, PARAM_FLOAT, 0, 0, 0.9, false, "", "share of the link's packets that is lost")              \
  X(delay, float, PARAM_FLOAT, 0, 0, 1, false, "s", "delay of the link's packets")                           \
  X(restart, uint8_t, PARAM_UINT8, 0, 0, 1, true, "", "back to the start, and switched on anew")

// X(name, C type, type)
#define DESK_LOGS(X)                                                                                         \
  X(x, float, LOG_FLOAT)                                                                                     \
  X(y, float, LOG_FLOAT)                                                                                     \
  X(z, float, LOG_FLOAT)                                                                                     \
  X(gap, float, LOG_FLOAT)                                                                                   \
  X(ratio, float, LOG_FLOAT)                                                                                 \
  X(contacts, uint32_t, LOG_UINT32)                                                                          \
  X(behind, float, LOG_FLOAT)

#define DESK_FIELD(name, c_type, ...) c_type name;
typedef struct {
  DESK_PARAMS(DESK_FIELD)
} desk_params_t;
// The truth: position, m; gap from the propellers to the ceiling, m; thrust ratio of rotor 1; contacts with
// the ceiling; and how far it is behind the clock, s.
typedef struct {
  DESK_LOGS(DESK_FIELD)
} desk_logs_t;
#undef DESK_FIELD

typedef struct {
  double initial, min, max;
  bool is_switch;
  const char *unit, *what;
} desk_range_t;

extern const stock_row_t desk_param_rows[], desk_log_rows[];
extern const desk_range_t desk_ranges[];
#define DESK_PARAMS_MAX 32

extern const int desk_param_count, desk_log_count;

// Returns its number; -1: none of that name.
int desk_param_find(const char *name);

// BAD_INPUT: there is no such parameter, or it does not take this value.
MUST_CHECK done_t desk_param_check(const char *name, double value, why_t *why);

#endif
