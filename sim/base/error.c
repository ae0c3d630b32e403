// error.c - one line for a person.
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>

status_t error_set(why_t *why, const char *format, ...) {
  va_list args;
  va_start(args, format);
  vsnprintf(why->text, sizeof why->text, format, args);
  va_end(args);
  return ST_BAD_INPUT;
}

status_t error_failed(why_t *why, const char *format, ...) {
  va_list args;
  va_start(args, format);
  vsnprintf(why->text, sizeof why->text, format, args);
  va_end(args);
  return ST_FAILED;
}

int error_exit(const char *program, status_t status, const why_t *why) {
  if (status == ST_OK) return 0;
  fprintf(stderr, "%s: %s\n", program, why->text);
  return status == ST_FAILED ? 1 : 2;
}
