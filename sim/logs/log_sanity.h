// log_sanity.h - does a whole flight agree with physics and with itself? Finds wrong units, signs and frames.
#ifndef SIM_LOGS_LOG_SANITY_H
#define SIM_LOGS_LOG_SANITY_H

#include "base/error.h"
#include "logs/log_rows.h"

typedef struct {
  long rows;
  double first_s, last_s, last_z_m; // of the rows
  double acc_sum_mps2;              // of |acceleration|
  long acc_rows;
  double climb2, climb_by_z; // sums of vz^2 dt and vz dz
  double command_max;
} log_sanity_t;

// A zeroed struct is the start.
void log_sanity_add(log_sanity_t *s, const log_row_t *row);

// BAD_INPUT: names the column, what it reads, what is allowed and the unit that would fit.
MUST_CHECK done_t log_sanity_check(const log_sanity_t *s, const log_rows_t *rows, why_t *why);

#endif
