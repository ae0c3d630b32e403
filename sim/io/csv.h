// csv.h - CSV files whose first row holds names, one row at a time, in fixed memory (parser: libcsv).
//
// Accepted: a comma between cells, a point in numbers, LF or CRLF, a UTF-8 byte order mark, quoted cells,
// blank lines. Files may be pipes and of any length. Every error is one line, `FILE:LINE: column NAME: what;
// what is allowed`.
#ifndef SIM_IO_CSV_H
#define SIM_IO_CSV_H

#include "error.h"
#include <stdbool.h>

#define CSV_COLUMN_MAX 256
#define CSV_LINE_MAX   32768 // bytes

typedef struct csv_file csv_file_t;

typedef enum { CSV_GAP_REFUSED, CSV_GAP_NAN } csv_gap_t;

// Reads the row of names. ST_BAD_INPUT: no such file, a folder, empty, not text, a name twice, a separator
// other than the comma, numbers where names should be; *file is null then.
MUST_CHECK status_t csv_open(csv_file_t **file, const char *path, why_t *why);

// A null pointer is allowed.
void csv_close(csv_file_t *file);

const char *csv_path(const csv_file_t *file);

// The column called `name`, counted from 0; -1 if there is none.
int csv_find(const csv_file_t *file, const char *name);

// The next row; *more is false at the end of the file. ST_BAD_INPUT: too few or too many cells, not text, a
// broken quote, or no row at all under the names.
MUST_CHECK status_t csv_next(csv_file_t *file, bool *more, why_t *why);

// The number in a column of the present row. Nothing and `nan` are gaps: NAN or an error, as the caller wants
// it. ST_BAD_INPUT: not a number, infinite, a decimal comma.
MUST_CHECK status_t csv_number(const csv_file_t *file, int column, csv_gap_t gap, double *value, why_t *why);

// An error in a column (-1: none) of the present row. Returns ST_BAD_INPUT.
status_t csv_refuse(const csv_file_t *file, int column, why_t *why, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
