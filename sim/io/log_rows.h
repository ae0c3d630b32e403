// log_rows.h - the rows of a flight log, one after the other, in SI and our frames.
#ifndef SIM_IO_LOG_ROWS_H
#define SIM_IO_LOG_ROWS_H

#include "io/columns.h"
#include "io/csv.h"
#include "model.h"

#define SIGNAL_BIT(signal) (1u << (signal))

typedef struct {
  // SI; NaN: a gap, or not logged. SIG_AX..: specific force in body axes. SIG_QW..: length one, turns body
  // into world, no jumps of sign. SIG_THRUST: newton in free air of all motors together, as commanded.
  // SIG_VBAT: the last one known.
  double v[SIG_COUNT];
  bool at_limit; // a motor is at full command
} log_row_t;

typedef struct {
  csv_file_t *csv;
  columns_t columns;
  model_t vehicle;
  int at[SIG_COUNT]; // column in the CSV, -1: none
  unsigned has;      // SIGNAL_BIT of what rows deliver
  bool any;          // `last` is one
  log_row_t last;
  double vbat_V; // the last one known
} log_rows_t;

// ST_BAD_INPUT: not a CSV, a column of the columns file is missing, or a signal in `need` (SIGNAL_BITs).
MUST_CHECK status_t log_rows_open(log_rows_t *r, const char *path, const columns_t *columns,
                                  const model_t *vehicle, unsigned need, why_t *why);

// ST_BAD_INPUT: not a number, beyond what is plausible (names the unit that would fit), or time that does not
// increase.
MUST_CHECK status_t log_rows_next(log_rows_t *r, log_row_t *row, bool *more, why_t *why);

void log_rows_close(log_rows_t *r);

#endif
