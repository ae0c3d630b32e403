// effectiveness_log.h - rates and commands from a log for effectiveness.h, by the firmware's columns or the
// app's.
#ifndef SIM_LOGS_EFFECTIVENESS_LOG_H
#define SIM_LOGS_EFFECTIVENESS_LOG_H

#include "logs/table.h"

enum { TIME, RATE, COMMAND = 4, THRUST = 7, COLUMNS };
extern const char *const effectiveness_names[COLUMNS];

// The app's own columns, used if those are missing: gyro, right-handed, and the four forces.
enum { OWN_TIME, OWN_RATE, OWN_FORCE = 4, OWN_COLUMNS = 8 };

typedef struct {
  table_t table;
  double motor_max_N;
  bool own; // the log has the app's own columns
  int own_column[OWN_COLUMNS];
  int column[COLUMNS];
} effectiveness_log_t;

// BAD_INPUT: a column is missing.
MUST_CHECK done_t effectiveness_log_find(effectiveness_log_t *p, why_t *why);

// The present row, in the units of the firmware's columns; yaw clockwise. BAD_INPUT: as table_number.
MUST_CHECK done_t effectiveness_log_row(const effectiveness_log_t *p, double row[COLUMNS], why_t *why);

#endif
