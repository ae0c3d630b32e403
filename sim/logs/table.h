// table.h - a log as a table of numbers under names, row by row: a CSV (base/csv.h), or a uSD log
// (logs/usd.h), which its first byte tells; either packed by gzip, too.
//
// Errors are one line, `FILE:LINE: column NAME: what`; for a uSD log LINE is the number of the record.
#ifndef SIM_LOGS_TABLE_H
#define SIM_LOGS_TABLE_H

#include "base/csv.h"
#include "logs/blocks.h"
#include "logs/usd.h"
#include <stdarg.h>

typedef struct {
  csv_file_t *csv; // one of the three is there
  usd_file_t *usd;
  blocks_t *blocks;
  void *list; // of the blocks' paths
  char path[1024];
} table_t;

// BAD_INPUT: as csv_open or usd_open.
MUST_CHECK done_t table_open(table_t *t, const char *path, why_t *why);

// The same, and the CSV files of one flight (logs/blocks.h): FILE+FILE+.., or a folder of nothing else.
MUST_CHECK done_t table_open_flight(table_t *t, const char *path, why_t *why);

// A last row that is cut off is left out.
void table_forgive_cut(table_t *t);

void table_close(table_t *t);

// The column called `name`, counted from 0; -1 if there is none.
int table_find(const table_t *t, const char *name);

// The next row; *more is false at the end, and where a uSD log is damaged. BAD_INPUT: as csv_next.
MUST_CHECK done_t table_next(table_t *t, bool *more, why_t *why);

// As csv_number; a uSD log has NaN for a gap.
MUST_CHECK done_t table_number(const table_t *t, int column, csv_gap_t gap, double *value, why_t *why);

// As blocks_times; 0 of a log that is one file.
blocks_times_t table_times(const table_t *t, int column);

// The number of the present row's line or record.
long table_line(const table_t *t);

// After the last row: what is damaged and where (one sentence), or false.
bool table_damage(const table_t *t, char *text, size_t size);

// An error in a column (-1: none) at a line (0: the present one). Returns BAD_INPUT.
done_t table_refuse(const table_t *t, long line, int column, why_t *why, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

#endif
