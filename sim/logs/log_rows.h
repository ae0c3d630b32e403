// log_rows.h - the rows of a flight log, one after the other, in SI and our frames.
#ifndef SIM_LOGS_LOG_ROWS_H
#define SIM_LOGS_LOG_ROWS_H

#include "logs/columns.h"
#include "logs/log_motors.h"
#include "logs/table.h"
#include "vehicle/model.h"

#define LOG_GAP_S 0.15 // rows that are farther apart have a gap between them

#define LOG_CELLS_LOST 0.05 // of a column, at most: with more, too much of it would be interpolated

// A cell that is no number or beyond what is plausible is taken as missing and counted.
// LOG_STRICT refuses commands that the vehicle's map cannot convert to newton, time that stands still, and a
// row cut off at the end. LOG_MEND gives such commands no newton, hands on rows whose time stands still, and
// leaves such a row out.
typedef enum { LOG_STRICT, LOG_MEND } log_care_t;

typedef struct {
  // SI; NaN: a gap, or not logged. SIG_AX..: specific force in body axes. SIG_QW..: length one, turns body
  // into world, no jumps of sign. SIG_THRUST, SIG_F1..: newton in free air of all motors together and of
  // each, as commanded. SIG_VBAT: the last one known.
  double v[SIG_COUNT];
  bool at_limit; // a motor is at full command
} log_row_t;

// The bad cells of a column.
typedef struct {
  long n, line; // line: of the first
  double value; // of the first, SI; infinite: no number
  bool length;  // value: of a quaternion
} bad_cells_t;

typedef struct {
  table_t table;
  columns_t columns;
  model_t vehicle;
  log_care_t care;
  int at[SIG_COUNT]; // column in the table, -1: none
  signals_t has;     // what rows deliver
  log_motors_t motors;
  char lacks[LOG_MOTORS_LACKS]; // LOG_MEND: why commands are not in newton; "": they are, or there are none
  bool any;                     // `last` is a row
  log_row_t last;
  double vbat_V; // the last one known
  long missing;  // cells
  bad_cells_t bad[SIG_COUNT];
  long clipped; // motor commands below 0 or above full
} log_rows_t;

// BAD_INPUT: no table, a column of the columns file is missing, or a signal in `need` (SIGNAL_BITs).
MUST_CHECK done_t log_rows_open(log_rows_t *r, const char *path, const columns_t *columns,
                                const model_t *vehicle, log_care_t care, signals_t need, why_t *why);

// After the last row. BAD_INPUT: more than LOG_CELLS_LOST of a column is bad; names the first such cell and
// the unit that would fit. rows: that were read.
MUST_CHECK done_t log_rows_check_cells(const log_rows_t *r, long rows, why_t *why);

// Returns the number of bad cells of all columns; `first` says where the first one is and how many there are.
long log_rows_bad(const log_rows_t *r, why_t *first);

// BAD_INPUT: no row of a table, a decimal comma, or time that is no number, not plausible or does not
// increase. LOG_STRICT: also a uSD log that is damaged, behind its last row.
MUST_CHECK done_t log_rows_next(log_rows_t *r, log_row_t *row, bool *more, why_t *why);

void log_rows_close(log_rows_t *r);

#endif
