// storage.c - parameters that outlast the program: a text file with lines "group.name = value".
#include "storage.h"

#include "base/number.h"
#include "base/whole_file.h"
#include "param.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE 128

static done_t take(storage_t *s, firmware_t *f, int line, char *text, why_t *why) {
  char name[LINE], number[LINE], more;
  double value;
  if (sscanf(text, " %127[^ =] = %127s %c", name, number, &more) != 2 || !number_parse(number, &value))
    return error_set(why, "%s:%d: allowed is `group.name = value`", s->path, line);
  const int i = firmware_param_find(f, name);
  if (i < 0 || !(firmware_param_row(f, i).type & PARAM_PERSISTENT)) {
    // It was stored by a firmware that had it.
    stand_in_print("DESK: %s cannot be stored, and is left out\n", name);
    return DONE;
  }
  s->value[i] = value;
  firmware_param_put(f, i, value);
  return DONE;
}

static done_t read_all(storage_t *s, firmware_t *f, FILE *file, why_t *why) {
  char text[LINE];
  for (int line = 1; fgets(text, sizeof text, file); line++)
    if (text[0] != '#' && text[0] != '\n') TRY(take(s, f, line, text, why));
  return DONE;
}

// Checked at the start, not when a client stores.
static done_t can_write(const char *path, why_t *why) {
  whole_files_t files = {0};
  FILE *file;
  const done_t status = whole_files_open(&files, path, &file, why);
  whole_files_drop(&files);
  return status;
}

static done_t read_file(storage_t *s, firmware_t *f, why_t *why) {
  TRY(can_write(s->path, why));
  FILE *const file = fopen(s->path, "r");
  if (!file && errno == ENOENT) return DONE;
  if (!file) return error_set(why, "%s: cannot be opened: %s", s->path, strerror(errno));
  const done_t status = read_all(s, f, file, why);
  fclose(file);
  return status;
}

done_t storage_open(storage_t *s, const char *path, firmware_t *f, why_t *why) {
  *s = (storage_t){.path = path, .n = firmware_params(f)};
  s->value = malloc((size_t)s->n * sizeof *s->value);
  if (!s->value) return error_failed(why, "out of memory");
  for (int i = 0; i < s->n; i++) s->value[i] = (double)NAN;
  const done_t status = path ? read_file(s, f, why) : DONE;
  if (status != DONE) storage_close(s);
  return status;
}

void storage_restore(const storage_t *s, firmware_t *f) {
  for (int i = 0; i < s->n; i++)
    if (!isnan(s->value[i])) firmware_param_put(f, i, s->value[i]);
}

void storage_close(storage_t *s) {
  free(s->value);
  s->value = NULL;
}

static void write_all(const storage_t *s, const firmware_t *f, FILE *file) {
  fputs("# parameters stored by a client, as the vehicle's own memory would hold them\n", file);
  for (int i = 0; i < s->n; i++) {
    const firmware_row_t row = firmware_param_row(f, i);
    if (!isnan(s->value[i])) fprintf(file, "%s.%s = %.17g\n", row.group, row.name, s->value[i]);
  }
}

bool storage_put(storage_t *s, const firmware_t *f, int param, double value) {
  const double was = s->value[param];
  s->value[param] = value;
  if (!s->path) return true;
  whole_files_t files = {0};
  FILE *file;
  why_t why;
  if (whole_files_open(&files, s->path, &file, &why) == DONE) {
    write_all(s, f, file);
    if (whole_files_commit(&files, &why) == DONE) return true;
    whole_files_drop(&files);
  }
  s->value[param] = was;
  return false;
}
