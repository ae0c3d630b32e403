// table.c - a log as a table of numbers under names.
#include "logs/table.h"

#include "base/number.h"
#include "base/stream.h"
#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

done_t table_open(table_t *t, const char *path, why_t *why) {
  *t = (table_t){0};
  if (strlen(path) >= sizeof t->path) return error_set(why, "%s: the path is too long", path);
  snprintf(t->path, sizeof t->path, "%s", path);
  FILE *stream;
  TRY(stream_open(&stream, path, why));
  return stream_peek(stream) == USD_MAGIC ? usd_open(&t->usd, stream, path, why)
                                          : csv_open_stream(&t->csv, stream, path, why);
}

// --- several files of one flight --------------------------------------------------------------------------

#define LIST_BYTES (BLOCKS_MAX * 300)

// Their paths, one behind the other in `text`.
typedef struct {
  int n;
  char text[LIST_BYTES];
  size_t used;
  const char *path[BLOCKS_MAX];
} list_t;

static bool list_add(list_t *list, const char *folder, const char *name, size_t size) {
  const size_t need = strlen(folder) + (*folder ? 1 : 0) + size + 1;
  if (list->n == BLOCKS_MAX || list->used + need > sizeof list->text) return false;
  char *const to = list->text + list->used;
  snprintf(to, need, "%s%s%.*s", folder, *folder ? "/" : "", (int)size, name);
  list->path[list->n++] = to;
  list->used += need;
  return true;
}

static int by_name(const void *a, const void *b) {
  return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool is_csv(const char *name) {
  const size_t n = strlen(name);
  return (n > 4 && strcmp(name + n - 4, ".csv") == 0) || (n > 7 && strcmp(name + n - 7, ".csv.gz") == 0);
}

static done_t list_folder(list_t *list, const char *path, why_t *why) {
  DIR *const folder = opendir(path);
  const struct dirent *entry;
  bool room = true;
  if (!folder) return error_set(why, "%s: cannot be opened", path);
  while (room && (entry = readdir(folder)) != NULL)
    if (is_csv(entry->d_name)) room = list_add(list, path, entry->d_name, strlen(entry->d_name));
  closedir(folder);
  if (!room)
    return error_set(why,
                     "%s: a folder with too many files; allowed: the log blocks of one flight, %d at most",
                     path, BLOCKS_MAX);
  if (list->n == 0)
    return error_set(
        why,
        "%s: cannot be read: Is a directory; allowed: a log, or a folder with the .csv files of one flight",
        path);
  qsort(list->path, (size_t)list->n, sizeof *list->path, by_name);
  return DONE;
}

static done_t list_joined(list_t *list, const char *path, why_t *why) {
  for (const char *at = path;; at++) {
    const size_t size = strcspn(at, "+");
    if (!list_add(list, "", at, size))
      return error_set(why, "%.300s: too many files; allowed: the log blocks of one flight, %d at most", path,
                       BLOCKS_MAX);
    at += size;
    if (*at == '\0') return DONE;
  }
}

done_t table_open_flight(table_t *t, const char *path, why_t *why) {
  struct stat is;
  const bool there = stat(path, &is) == 0, folder = there && S_ISDIR(is.st_mode);
  if (!folder && (there || !strchr(path, '+'))) return table_open(t, path, why);
  *t = (table_t){0};
  snprintf(t->path, sizeof t->path, "%s", path);
  list_t *const list = calloc(1, sizeof *list);
  if (!list) return error_failed(why, "out of memory");
  done_t status = folder ? list_folder(list, path, why) : list_joined(list, path, why);
  if (status == DONE) status = blocks_open(&t->blocks, list->path, list->n, why);
  if (status != DONE) free(list);
  if (status == DONE) t->list = list;
  return status;
}

void table_forgive_cut(table_t *t) {
  if (t->csv) csv_forgive_cut(t->csv);
  if (t->blocks) blocks_forgive_cut(t->blocks);
}

// --- one table ---------------------------------------------------------------------------------------------

void table_close(table_t *t) {
  csv_close(t->csv);
  usd_close(t->usd);
  blocks_close(t->blocks);
  free(t->list);
  *t = (table_t){0};
}

int table_find(const table_t *t, const char *name) {
  if (t->blocks) return blocks_find(t->blocks, name);
  return t->csv ? csv_find(t->csv, name) : usd_find(t->usd, name);
}

done_t table_next(table_t *t, bool *more, why_t *why) {
  if (t->csv) return csv_next(t->csv, more, why);
  if (t->blocks) return blocks_next(t->blocks, more, why);
  *more = usd_next(t->usd);
  return DONE;
}

done_t table_number(const table_t *t, int column, csv_gap_t gap, double *value, why_t *why) {
  if (t->csv) return csv_number(t->csv, column, gap, value, why);
  if (t->blocks) return blocks_number(t->blocks, column, gap, value, why);
  *value = usd_value(t->usd, column);
  if (isnan(*value) && gap == CSV_GAP_REFUSED)
    return table_refuse(t, 0, column, why, "a gap; allowed: a number");
  if (isinf(*value) && gap != CSV_GAP_MARKED)
    return table_refuse(t, 0, column, why, "not finite; allowed: a number");
  return DONE;
}

blocks_times_t table_times(const table_t *t, int column) {
  return t->blocks && column >= 0 ? blocks_times(t->blocks, column) : (blocks_times_t){0.0, 0.0};
}

long table_line(const table_t *t) {
  if (t->blocks) return blocks_line(t->blocks);
  return t->csv ? csv_line(t->csv) : usd_record(t->usd);
}

bool table_damage(const table_t *t, char *text, size_t size) {
  const char *const usd = t->usd ? usd_damage(t->usd) : NULL;
  if (usd) snprintf(text, size, "%s: %s", t->path, usd);
  if (t->csv && csv_cut_off(t->csv))
    snprintf(text, size, "%s:%ld: the file is cut off in this row", t->path, csv_line(t->csv));
  if (t->blocks && blocks_cut_off(t->blocks))
    snprintf(text, size, "%s: a file is cut off in its last row", t->path);
  return usd || (t->csv && csv_cut_off(t->csv)) || (t->blocks && blocks_cut_off(t->blocks));
}

static const char *table_name(const table_t *t, int column) {
  if (t->blocks) return blocks_name(t->blocks, column);
  return t->csv ? csv_name(t->csv, column) : usd_name(t->usd, column);
}

done_t table_refuse(const table_t *t, long line, int column, why_t *why, const char *format, ...) {
  char what[400], where[80] = "", shown[NUMBER_SHOWN];
  va_list args;
  va_start(args, format);
  vsnprintf(what, sizeof what, format, args);
  va_end(args);
  if (column >= 0) snprintf(where, sizeof where, " column %s:", number_shown(table_name(t, column), shown));
  return error_set(why, "%s:%ld:%s %s", t->blocks ? blocks_path(t->blocks, column) : t->path,
                   line ? line : table_line(t), where, what);
}
