// blocks.h - the files of one flight that cfclient writes, one for each log block, as one table.
//
// Every file has a column `Timestamp` (or `timestamp`) in milliseconds of one clock. The table has the rows
// of the file with the motor commands, else of the first file. Values of the other files are interpolated
// linearly to the times of these rows if their own rows are at most BLOCKS_APART_MS apart, and are gaps
// elsewhere. Ranges are not interpolated: the newest value counts.
#ifndef SIM_LOGS_BLOCKS_H
#define SIM_LOGS_BLOCKS_H

#include "base/csv.h"

#define BLOCKS_MAX      16
#define BLOCKS_APART_MS 150.0

typedef struct blocks blocks_t;

// BAD_INPUT: as csv_open, more files than BLOCKS_MAX, one without a time, a column that two of them have;
// *blocks is null then.
MUST_CHECK done_t blocks_open(blocks_t **blocks, const char *const *path, int n, why_t *why);

// A null pointer is allowed.
void blocks_close(blocks_t *blocks);

// As csv_find, csv_name, csv_line, csv_forgive_cut, csv_cut_off. The time is called as in its file.
int blocks_find(const blocks_t *blocks, const char *name);
const char *blocks_name(const blocks_t *blocks, int column);
long blocks_line(const blocks_t *blocks);
void blocks_forgive_cut(blocks_t *blocks);
bool blocks_cut_off(const blocks_t *blocks);

// The file that a column (-1: the rows) is from.
const char *blocks_path(const blocks_t *blocks, int column);

// As csv_next and csv_number. BAD_INPUT: also time that runs backwards in one of the files.
MUST_CHECK done_t blocks_next(blocks_t *blocks, bool *more, why_t *why);
MUST_CHECK done_t blocks_number(const blocks_t *blocks, int column, csv_gap_t gap, double *value, why_t *why);

// Times of a column that is not interpolated, s, means so far. late_s: from a new value in its own file to
// the table's row in which it first stands; apart_s: between its file's rows. Both are 0 in the file whose
// rows the table has.
typedef struct {
  double late_s, apart_s;
} blocks_times_t;
blocks_times_t blocks_times(const blocks_t *blocks, int column);

#endif
