// csv.h - reads CSV files whose first row holds names, one row at a time, in fixed memory (parser: libcsv).
//
// Accepted: a comma between cells, a point in numbers, LF or CRLF, a UTF-8 byte order mark, quoted cells,
// blank lines. Files may be pipes and of any length. Every error is one line, `FILE:LINE: column NAME: what
// is wrong; what is allowed`.
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
  CSV_GAP_MARKED, // as CSV_GAP_NAN; a cell that is not a number, or is infinite, gives INFINITY
} csv_gap_t;

// Opens the file and reads the row of names. BAD_INPUT: there is no such file, it is a folder, empty or not
// text, a name stands twice, the separator is not the comma, or numbers stand where names should; *file is
// null then.
MUST_CHECK done_t csv_open(csv_file_t **file, const char *path, why_t *why);

// The same from a stream, which is closed with the file, also on an error; errors call it `path`.
MUST_CHECK done_t csv_open_stream(csv_file_t **file, FILE *stream, const char *path, why_t *why);

// A null pointer is allowed.
void csv_close(csv_file_t *file);

// The number, from 1, of the line on which the current row ends.
long csv_line(const csv_file_t *file);

int csv_columns(const csv_file_t *file);

// The name of a column; the column must exist.
const char *csv_name(const csv_file_t *file, int column);

// From now on a truncated last row (too few cells, no newline) is left out, and csv_cut_off returns true.
void csv_forgive_cut(csv_file_t *file);
bool csv_cut_off(const csv_file_t *file);

// The column called `name`, counted from 0; -1 if there is none.
int csv_find(const csv_file_t *file, const char *name);

// Reads the next row; *more is false at the end of the file. BAD_INPUT: too few or too many cells, not text,
// a broken quote, or no row at all under the names.
MUST_CHECK done_t csv_next(csv_file_t *file, bool *more, why_t *why);

// The number in a column of the current row. An empty cell and `nan` are gaps: NAN or an error, depending on
// `gap`. BAD_INPUT: not a number or infinite (unless CSV_GAP_MARKED), or a decimal comma.
MUST_CHECK done_t csv_number(const csv_file_t *file, int column, csv_gap_t gap, double *value, why_t *why);

// Reports an error in a column (-1: in none) of the current row. Returns BAD_INPUT.
done_t csv_refuse(const csv_file_t *file, int column, why_t *why, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
