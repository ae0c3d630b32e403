// whole_file.c - a file that is complete or not there.
#include "io/whole_file.h"

#include <errno.h>
#include <string.h>

status_t whole_file_open(whole_file_t *f, const char *path, why_t *why) {
  if (strlen(path) >= sizeof f->path) return error_set(why, "%.60s...: the path is too long", path);
  snprintf(f->path, sizeof f->path, "%s", path);
  snprintf(f->beside, sizeof f->beside, "%s.part", path);
  f->file = fopen(f->beside, "w");
  if (!f->file) return error_set(why, "%s: cannot be written: %s", path, strerror(errno));
  return ST_OK;
}

status_t whole_file_close(whole_file_t *f, why_t *why) {
  const int bad = ferror(f->file);
  if ((fclose(f->file) | bad) == 0 && rename(f->beside, f->path) == 0) return ST_OK;
  const int cause = errno;
  remove(f->beside);
  return error_set(why, "%s: cannot be written: %s", f->path, strerror(cause));
}

void whole_file_drop(whole_file_t *f) {
  fclose(f->file);
  remove(f->beside);
}
