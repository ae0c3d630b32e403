// error.c - one line for a person.
#include "error.h"

#include <stdarg.h>
#include <stdio.h>

status_t error_set(why_t *why, const char *format, ...) {
  va_list args;
  va_start(args, format);
  vsnprintf(why->text, sizeof why->text, format, args);
  va_end(args);
  return ST_BAD_INPUT;
}
