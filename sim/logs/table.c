// table.c - a log as a table of numbers under names.
#include "logs/table.h"

#include "base/number.h"
#include <errno.h>
#include <math.h>
#include <string.h>

done_t table_open(table_t *t, const char *path, why_t *why) {
  *t = (table_t){0};
  if (strlen(path) >= sizeof t->path) return error_set(why, "%s: the path is too long", path);
  snprintf(t->path, sizeof t->path, "%s", path);
  FILE *const stream = fopen(path, "rb");
  if (!stream) return error_set(why, "%s: cannot be opened: %s", path, strerror(errno));
  errno = 0;
  const int first = getc(stream);
  if (ferror(stream)) { // a folder
    const int cause = errno;
    fclose(stream);
    return error_set(why, "%s: cannot be read: %s", path, strerror(cause));
  }
  if (first != EOF) ungetc(first, stream);
  return first == USD_MAGIC ? usd_open(&t->usd, stream, path, why)
                            : csv_open_stream(&t->csv, stream, path, why);
}

void table_close(table_t *t) {
  csv_close(t->csv);
  usd_close(t->usd);
  *t = (table_t){0};
}

int table_find(const table_t *t, const char *name) {
  return t->csv ? csv_find(t->csv, name) : usd_find(t->usd, name);
}

done_t table_next(table_t *t, bool *more, why_t *why) {
  if (t->csv) return csv_next(t->csv, more, why);
  *more = usd_next(t->usd);
  return DONE;
}

done_t table_number(const table_t *t, int column, csv_gap_t gap, double *value, why_t *why) {
  if (t->csv) return csv_number(t->csv, column, gap, value, why);
  *value = usd_value(t->usd, column);
  if (isnan(*value) && gap == CSV_GAP_REFUSED)
    return table_refuse(t, 0, column, why, "a gap; allowed: a number");
  if (isinf(*value) && gap != CSV_GAP_MARKED)
    return table_refuse(t, 0, column, why, "not finite; allowed: a number");
  return DONE;
}

long table_line(const table_t *t) {
  return t->csv ? csv_line(t->csv) : usd_record(t->usd);
}

bool table_damage(const table_t *t, char *text, size_t size) {
  const char *const usd = t->usd ? usd_damage(t->usd) : NULL;
  if (usd) snprintf(text, size, "%s: %s", t->path, usd);
  if (t->csv && csv_cut_off(t->csv))
    snprintf(text, size, "%s:%ld: the file is cut off in this row", t->path, csv_line(t->csv));
  return usd || (t->csv && csv_cut_off(t->csv));
}

done_t table_refuse(const table_t *t, long line, int column, why_t *why, const char *format, ...) {
  char what[400], where[80] = "", shown[NUMBER_SHOWN];
  va_list args;
  va_start(args, format);
  vsnprintf(what, sizeof what, format, args);
  va_end(args);
  if (column >= 0)
    snprintf(where, sizeof where, " column %s:",
             number_shown(t->csv ? csv_name(t->csv, column) : usd_name(t->usd, column), shown));
  return error_set(why, "%s:%ld:%s %s", t->path, line ? line : table_line(t), where, what);
}
