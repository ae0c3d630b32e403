// log_sanity.h - does a whole flight agree with physics and with itself? Finds wrong units, signs and frames.
#ifndef SIM_LOGS_LOG_SANITY_H
#define SIM_LOGS_LOG_SANITY_H

#include "base/error.h"
#include "logs/log_rows.h"

// Mean |acceleration| of a flight, over g: a vehicle that stays up has 1, an aggressive flight 2; g taken for
// m/s2, and the other way round, is a factor of 9.81.
#define LOG_ACC_MIN 0.5
#define LOG_ACC_MAX 3.1

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

// A number of the whole flight that is out of its bounds, with the unit that would bring it there. Returns
// BAD_INPUT.
done_t log_refuse(const log_rows_t *rows, signal_id_t i, const char *what, double value, double min,
                  double max, why_t *why);

#endif
