// flight_log.h - a recorded flight on the flight code's 100 Hz grid, in SI, tick by tick, in fixed memory.
//
// With three rows or more per tick, a tick is their mean; in a slower log it is interpolated linearly. Rows
// without a signal that is needed (a bad cell is no signal) are left out and counted. Where rows are more
// than LOG_GAP_S apart the flight is split: a new grid starts, the tick says so, and filters must start
// again. Time that does not increase is refused, never sorted.
#ifndef SIM_LOGS_FLIGHT_LOG_H
#define SIM_LOGS_FLIGHT_LOG_H

#include "base/error.h"
#include "logs/log_rows.h"
#include <stdbool.h>

#define FLIGHT_LOG_PERIOD_S 0.01

typedef struct {
  double v[SIG_COUNT]; // as in log_row_t; SIG_RANGE: the newest sample
  double applied_N;    // thrust command during the period that ends with the tick
  bool split;          // the first tick, or the first one after a gap
  bool at_limit;       // a motor was at full command during the period
  bool range_new;      // SIG_RANGE is newer than at the last tick
} flight_tick_t;

typedef struct flight_log flight_log_t;

typedef struct {
  long rows, gaps, ticks, splits; // gaps: rows left out
} flight_log_count_t;

// need: SIGNAL_BITs of the signals without which a row is of no use. Errors: as log_rows_open; *log is null
// then.
MUST_CHECK done_t flight_log_open(flight_log_t **log, const char *path, const columns_t *columns,
                                  const model_t *vehicle, signals_t need, why_t *why);

// *more is false at the end. BAD_INPUT: as log_rows_next; at the end as log_rows_check_cells, or if the
// signals contradict physics or each other over the whole flight: rows too close or too far, mean
// |acceleration| not near 1 g, z not moving as vz says, commands that never exceed 100.
MUST_CHECK done_t flight_log_next(flight_log_t *log, flight_tick_t *tick, bool *more, why_t *why);

// The log holds this signal.
bool flight_log_has(const flight_log_t *log, signal_id_t signal);

flight_log_count_t flight_log_count(const flight_log_t *log);

// As log_rows_bad.
long flight_log_bad(const flight_log_t *log, why_t *first);

// A null pointer is allowed.
void flight_log_close(flight_log_t *log);

#endif
