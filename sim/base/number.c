// number.c - a number as text.
#define _GNU_SOURCE // strtod_l
#include "base/number.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool number_parse(const char *text, double *value) {
  // strtod also takes blanks, hexadecimal numbers, `inf` and `nan`.
  const size_t size = strspn(text, "0123456789+-.eE");
  if (size == 0 || text[size] != '\0') return false;
  if (number_read(text, size, value)) return true;
  char *end;
  // The "C" locale is built in: this neither allocates nor fails.
  const locale_t point = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  *value = strtod_l(text, &end, point);
  freelocale(point);
  return *end == '\0';
}

const char *number_shown(const char *text, char shown[NUMBER_SHOWN]) {
  snprintf(shown, NUMBER_SHOWN, "%s", text);
  if (strlen(text) >= NUMBER_SHOWN) memcpy(shown + NUMBER_SHOWN - 4, "...", 4);
  for (char *c = shown; *c; c++)
    if (*c < ' ' || *c > '~') *c = '?';
  return shown;
}
