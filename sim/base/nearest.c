// nearest.c - suggests names.
#include "base/nearest.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#define LETTERS_PER_SLIP 3

static int least(int a, int b) {
  return a < b ? a : b;
}

static int letter(const char *word, size_t i) {
  return tolower((unsigned char)word[i]);
}

int nearest_slips(const char *a, const char *b) {
  int d[NEAREST_LETTERS + 1][NEAREST_LETTERS + 1];
  const size_t n = strlen(a), m = strlen(b);
  if (n > NEAREST_LETTERS || m > NEAREST_LETTERS) return INT_MAX;
  for (size_t i = 0; i <= n; i++) {
    for (size_t k = 0; k <= m; k++) {
      if (i == 0 || k == 0) {
        d[i][k] = (int)(i + k);
        continue;
      }
      const int changed = letter(a, i - 1) != letter(b, k - 1);
      d[i][k] = least(d[i - 1][k - 1] + changed, least(d[i - 1][k], d[i][k - 1]) + 1);
      if (i > 1 && k > 1 && letter(a, i - 1) == letter(b, k - 2) && letter(a, i - 2) == letter(b, k - 1))
        d[i][k] = least(d[i][k], d[i - 2][k - 2] + 1);
    }
  }
  return d[n][m];
}

nearest_t nearest_to(const char *typed) {
  return (nearest_t){.typed = typed, .slips = INT_MAX};
}

void nearest_try(nearest_t *n, const char *name) {
  const int slips = nearest_slips(n->typed, name);
  if (slips >= n->slips || slips > (int)strlen(n->typed) / LETTERS_PER_SLIP) return;
  n->slips = slips;
  n->name = name;
}

const char *nearest_hint(const nearest_t *n, char hint[NEAREST_HINT]) {
  hint[0] = '\0';
  if (n->name) snprintf(hint, NEAREST_HINT, " (did you mean %s?)", n->name);
  return hint;
}

const char *nearest_of(const char *typed, const char *const *names, char hint[NEAREST_HINT]) {
  nearest_t n = nearest_to(typed);
  for (; *names; names++) nearest_try(&n, *names);
  return nearest_hint(&n, hint);
}
