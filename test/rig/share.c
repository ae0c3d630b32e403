// share.c - promises about shares.
#include "rig/share.h"

#include <stdio.h>
#include <stdlib.h>

#define SEED_MAX 999999L
#define RANGE    10000u // seeds for each SEED

uint64_t share_seed(uint64_t usual) {
  const char *const text = getenv("SEED");
  if (!text || !*text) return usual;
  char *end;
  const long seed = strtol(text, &end, 10);
  if (*end || seed < 1 || seed > SEED_MAX) {
    fprintf(stderr, "tests: SEED=%s: allowed is a whole number from 1 to %ld\n", text, SEED_MAX);
    exit(2);
  }
  return usual + (uint64_t)seed * RANGE;
}

bool share_check(const char *file, int line, const char *what, int kept, int n, double promise) {
  const int fewest = share_fewest(n, promise);
  char text[200];
  snprintf(text, sizeof text, "%s = %d of %d, promised are %g %%, at least %d", what, kept, n,
           100.0 * promise, fewest);
  return test_check(file, line, text, fewest > 0 && kept >= fewest);
}
