// error.c - error messages of one line.
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>

done_t error_set(why_t *why, const char *format, ...) {
  va_list args;
  va_start(args, format);
  vsnprintf(why->text, sizeof why->text, format, args);
  va_end(args);
  return BAD_INPUT;
}

done_t error_failed(why_t *why, const char *format, ...) {
  va_list args;
  va_start(args, format);
  vsnprintf(why->text, sizeof why->text, format, args);
  va_end(args);
  return FAILED;
}

int error_exit(const char *program, done_t status, const why_t *why) {
  if (status == DONE) return 0;
  fprintf(stderr, "%s: %s\n", program, why->text);
  return status == FAILED ? 1 : 2;
}
