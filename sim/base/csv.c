// csv.c - CSV files, one row at a time.
#define _POSIX_C_SOURCE 200809L // getc_unlocked
#include "base/csv.h"

#include "base/number.h"
#include <csv.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct {
  int count;                        // number of cells, including those beyond CSV_COLUMN_MAX
  const char *cell[CSV_COLUMN_MAX]; // each points into text
  size_t used;
  char text[CSV_LINE_MAX];
} row_t;

struct csv_file {
  FILE *stream;
  struct csv_parser parser;
  char path[256];
  char line[CSV_LINE_MAX];
  long line_number; // of the last line read
  long rows;        // data rows so far, without the row of names
  row_t name, row;
  row_t *into;   // the row that the parser fills
  bool ended;    // the parser has reached the end of a row
  bool overflow; // a row over several lines is too long
  bool forgive, cut_off;
};

done_t csv_refuse(const csv_file_t *file, int column, why_t *why, const char *format, ...) {
  char what[400], where[80] = "", shown[NUMBER_SHOWN];
  va_list args;
  va_start(args, format);
  vsnprintf(what, sizeof what, format, args);
  va_end(args);
  if (column >= 0 && column < file->name.count)
    snprintf(where, sizeof where, " column %s:", number_shown(file->name.cell[column], shown));
  return error_set(why, "%s:%ld:%s %s", file->path, file->line_number, where, what);
}

long csv_line(const csv_file_t *file) {
  return file->line_number;
}

const char *csv_name(const csv_file_t *file, int column) {
  return file->name.cell[column];
}

int csv_columns(const csv_file_t *file) {
  return file->name.count;
}

void csv_forgive_cut(csv_file_t *file) {
  file->forgive = true;
}

bool csv_cut_off(const csv_file_t *file) {
  return file->cut_off;
}

static int is_blank(unsigned char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
static int is_line_end(unsigned char c) {
  return c == '\n';
}

static void on_cell(void *cell, size_t size, void *user) {
  csv_file_t *const file = user;
  row_t *const row = file->into;
  if (size >= sizeof row->text - row->used) {
    file->overflow = true;
    return;
  }
  char *const to = row->text + row->used;
  memcpy(to, cell, size);
  to[size] = '\0';
  row->used += size + 1;
  if (row->count < CSV_COLUMN_MAX) row->cell[row->count] = to;
  row->count++;
}

static void on_row(int ending, void *user) {
  (void)ending;
  ((csv_file_t *)user)->ended = true;
}

// Reads one line with its LF; *size is 0 at the end of the file.
static done_t read_line(csv_file_t *file, size_t *size, why_t *why) {
  *size = 0;
  file->line_number++;
  for (int c = 0; c != '\n' && (c = getc_unlocked(file->stream)) != EOF;) {
    if (c == '\0') return csv_refuse(file, -1, why, "not a text file; allowed: CSV");
    if (*size == sizeof file->line)
      return csv_refuse(file, -1, why, "the line is too long; allowed: %d bytes", CSV_LINE_MAX);
    file->line[(*size)++] = (char)c;
  }
  if (ferror(file->stream)) return csv_refuse(file, -1, why, "cannot be read: %s", strerror(errno));
  if (*size == 0 && file->line_number > 1) file->line_number--; // the end of the file is not a line
  return DONE;
}

// Reads the next row that is not blank; at the end of the file into->count stays 0.
static done_t read_row(csv_file_t *file, row_t *into, why_t *why) {
  into->count = 0;
  into->used = 0;
  file->into = into;
  file->ended = false;
  while (!file->ended) {
    size_t size;
    TRY(read_line(file, &size, why));
    const bool bom = file->line_number == 1 && size >= 3 && memcmp(file->line, "\xEF\xBB\xBF", 3) == 0;
    const size_t skip = bom ? 3 : 0;
    bool good =
        csv_parse(&file->parser, file->line + skip, size - skip, on_cell, on_row, file) == size - skip;
    if (size == 0) good = csv_fini(&file->parser, on_cell, on_row, file) == 0;
    if (!good) return csv_refuse(file, -1, why, "a quote that does not end or stands inside a cell");
    if (file->overflow)
      return csv_refuse(file, -1, why, "the row is too long; allowed: %d bytes", CSV_LINE_MAX);
    if (size == 0) break;
  }
  return DONE;
}

static done_t check_names(const csv_file_t *file, why_t *why) {
  const row_t *name = &file->name;
  char shown[NUMBER_SHOWN];
  double number;
  if (name->count == 0)
    return error_set(why, "%s:1: the file is empty; allowed: a row of names and rows of numbers", file->path);
  if (name->count > CSV_COLUMN_MAX)
    return csv_refuse(file, -1, why, "%d columns; allowed: %d", name->count, CSV_COLUMN_MAX);
  if (name->count == 1 && strpbrk(name->cell[0], ";\t"))
    return csv_refuse(file, -1, why, "the separator is %s; allowed: `,` between cells and `.` in numbers",
                      strchr(name->cell[0], ';') ? "`;`" : "a tab");
  for (int i = 0; i < name->count; i++) {
    if (number_parse(name->cell[i], &number))
      return csv_refuse(file, -1, why, "cell %d is the number %s; allowed: the first row holds the names",
                        i + 1, number_shown(name->cell[i], shown));
    for (int j = 0; j < i && name->cell[i][0] != '\0'; j++)
      if (strcmp(name->cell[i], name->cell[j]) == 0)
        return csv_refuse(file, i, why, "the name stands twice, in cells %d and %d; allowed: once", j + 1,
                          i + 1);
  }
  return DONE;
}

static done_t start(csv_file_t *file, why_t *why) {
  // Opening a folder succeeds; reading it does not.
  errno = 0;
  const int first = getc_unlocked(file->stream);
  if (ferror(file->stream)) return error_set(why, "%s: cannot be read: %s", file->path, strerror(errno));
  if (first != EOF) ungetc(first, file->stream);
  if (csv_init(&file->parser, CSV_STRICT | CSV_STRICT_FINI) != 0) return error_failed(why, "out of memory");
  csv_set_space_func(&file->parser, is_blank);
  csv_set_term_func(&file->parser, is_line_end);
  TRY(read_row(file, &file->name, why));
  return check_names(file, why);
}

done_t csv_open(csv_file_t **file, const char *path, why_t *why) {
  *file = NULL;
  FILE *const stream = fopen(path, "rb");
  if (!stream) return error_set(why, "%s: cannot be opened: %s", path, strerror(errno));
  return csv_open_stream(file, stream, path, why);
}

done_t csv_open_stream(csv_file_t **file, FILE *stream, const char *path, why_t *why) {
  *file = NULL;
  csv_file_t *const fresh = calloc(1, sizeof *fresh);
  if (!fresh) {
    fclose(stream);
    return error_failed(why, "%s: out of memory", path);
  }
  fresh->stream = stream;
  snprintf(fresh->path, sizeof fresh->path, "%s", path);
  const done_t status = strlen(path) < sizeof fresh->path ? start(fresh, why)
                                                          : error_set(why, "%s: the path is too long", path);
  if (status == DONE)
    *file = fresh;
  else
    csv_close(fresh);
  return status;
}

void csv_close(csv_file_t *file) {
  if (!file) return;
  if (file->stream) fclose(file->stream);
  if (file->parser.is_term) csv_free(&file->parser);
  free(file);
}

int csv_find(const csv_file_t *file, const char *name) {
  for (int i = 0; i < file->name.count; i++)
    if (strcmp(file->name.cell[i], name) == 0) return i;
  return -1;
}

done_t csv_next(csv_file_t *file, bool *more, why_t *why) {
  *more = false;
  TRY(read_row(file, &file->row, why));
  const int got = file->row.count, want = file->name.count;
  if (got == 0 && file->rows == 0)
    return error_set(why, "%s:1: no row under the names; allowed: one or more", file->path);
  file->cut_off = file->forgive && got > 0 && got < want && feof(file->stream);
  if (got == 0 || file->cut_off) return DONE;
  if (got < want)
    return csv_refuse(file, got, why, "missing: the row has %d cells, the first row names %d (cut off here?)",
                      got, want);
  if (got > want)
    return csv_refuse(file, -1, why,
                      "%d cells where the first row names %d; allowed: `,` between cells and `.` in numbers",
                      got, want);
  file->rows++;
  *more = true;
  return DONE;
}

static done_t no_number(const csv_file_t *file, int column, csv_gap_t gap, const char *cell, why_t *why) {
  char shown[NUMBER_SHOWN];
  if (strchr(cell, ','))
    return csv_refuse(file, column, why, "decimal comma in `%s`; allowed: `.`", number_shown(cell, shown));
  return csv_refuse(file, column, why, "not a number: `%s`; allowed: a number%s", number_shown(cell, shown),
                    gap == CSV_GAP_NAN ? ", or nan or nothing for a gap" : "");
}

done_t csv_number(const csv_file_t *file, int column, csv_gap_t gap, double *value, why_t *why) {
  const char *const cell = file->row.cell[column];
  char shown[NUMBER_SHOWN];
  double number = (double)NAN;
  if (cell[0] == '\0' || strcasecmp(cell + (cell[0] == '-'), "nan") == 0) {
    if (gap == CSV_GAP_REFUSED) return csv_refuse(file, column, why, "a gap; allowed: a number");
  } else if (!number_parse(cell, &number)) {
    if (gap != CSV_GAP_MARKED || strchr(cell, ',')) return no_number(file, column, gap, cell, why);
    number = HUGE_VAL;
  } else if (!isfinite(number) && gap != CSV_GAP_MARKED) {
    return csv_refuse(file, column, why, "not finite: `%s`; allowed: a number", number_shown(cell, shown));
  }
  *value = number;
  return DONE;
}
