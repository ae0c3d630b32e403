// csv.h - CSV files whose first row holds names, one row at a time, in fixed memory (parser: libcsv).
//
// Accepted: a comma between cells, a point in numbers, LF or CRLF, a UTF-8 byte order mark, quoted cells,
// blank lines. Files may be pipes and of any length. Every error is one line, `FILE:LINE: column NAME: what;
// what is allowed`.
#ifndef SIM_BASE_CSV_H
#define SIM_BASE_CSV_H

#include "base/error.h"
#include <stdbool.h>
#include <stdio.h>

#define CSV_COLUMN_MAX 256
#define CSV_LINE_MAX   32768 // bytes

typedef struct csv_file csv_file_t;

typedef enum {
  CSV_GAP_REFUSED,
  CSV_GAP_NAN,
  CSV_GAP_MARKED, // as CSV_GAP_NAN; a cell that is no number, or infinite, is INFINITY
} csv_gap_t;

// Reads the row of names. BAD_INPUT: no such file, a folder, empty, not text, a name twice, a separator
// other than the comma, numbers where names should be; *file is null then.
MUST_CHECK done_t csv_open(csv_file_t **file, const char *path, why_t *why);

// The same from a stream, closed with the file (also where this fails); `path` is what errors call it.
MUST_CHECK done_t csv_open_stream(csv_file_t **file, FILE *stream, const char *path, why_t *why);

// A null pointer is allowed.
void csv_close(csv_file_t *file);

// The number of the line that the present row ends with, from 1.
long csv_line(const csv_file_t *file);

int csv_columns(const csv_file_t *file);

// The name of a column that there is.
const char *csv_name(const csv_file_t *file, int column);

// From now on a last row that is cut off (too few cells, no newline) is left out; csv_cut_off says so.
void csv_forgive_cut(csv_file_t *file);
bool csv_cut_off(const csv_file_t *file);

// The column called `name`, counted from 0; -1 if there is none.
int csv_find(const csv_file_t *file, const char *name);

// The next row; *more is false at the end of the file. BAD_INPUT: too few or too many cells, not text, a
// broken quote, or no row at all under the names.
MUST_CHECK done_t csv_next(csv_file_t *file, bool *more, why_t *why);

// The number in a column of the present row. Nothing and `nan` are gaps: NAN or an error, as the caller wants
// it, see csv_gap_t. BAD_INPUT: not a number, infinite, a decimal comma.
MUST_CHECK done_t csv_number(const csv_file_t *file, int column, csv_gap_t gap, double *value, why_t *why);

// An error in a column (-1: none) of the present row. Returns BAD_INPUT.
done_t csv_refuse(const csv_file_t *file, int column, why_t *why, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
