// test_main.c - runs the tests whose file or name contains the word of the first argument.
#include "test.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char row[160];
static int failures;        // of the running test
static const char *skipped; // why the running test was skipped

void test_row(const char *format, ...) {
  va_list args;
  va_start(args, format);
  vsnprintf(row, sizeof row, format, args);
  va_end(args);
}

static void report(const char *file, int line) {
  failures++;
  printf("%s:%d: %s%s", file, line, row, row[0] ? ": " : "");
}

bool test_check(const char *file, int line, const char *what, bool ok) {
  if (ok) return true;
  report(file, line);
  printf("%s is false\n", what);
  return false;
}

bool test_near(const char *file, int line, const char *what, double got, double want, double tol) {
  if (fabs(got - want) <= tol) return true;
  report(file, line);
  printf("%s = %.9g, want %.9g +- %.3g\n", what, got, want, tol);
  return false;
}

bool test_status(const char *file, int line, const char *what, status_t want, status_t got) {
  if (got == want) return true;
  report(file, line);
  printf("%s = %s, want %s\n", what, status_name(got), status_name(want));
  return false;
}

bool test_text(const char *file, int line, const char *what, const char *got, const char *want) {
  if (strcmp(got, want) == 0) return true;
  report(file, line);
  printf("%s = `%s`, want `%s`\n", what, got, want);
  return false;
}

void test_skip(const char *why) {
  skipped = why;
}

const char *test_data_dir(void) {
  const char *dir = getenv("DATA");
  return dir && dir[0] ? dir : NULL;
}

bool test_long(void) {
  return getenv("TEST_LONG") != NULL;
}

typedef struct {
  int passed, failed, skipped;
} tally_t;

static void run(const test_t *test, tally_t *sum) {
  row[0] = '\0';
  failures = 0;
  skipped = NULL;
  test->run();
  if (skipped && failures == 0) {
    printf("%s: skipped: %s\n", test->name, skipped);
    sum->skipped++;
  } else if (failures == 0) {
    sum->passed++;
  } else {
    printf("FAILED %s\n", test->name);
    sum->failed++;
  }
  fflush(stdout);
}

int main(int argc, char **argv) {
  const char *word = argc > 1 ? argv[1] : "";
  tally_t sum = {0}, file = {0};
  for (int i = 0; i < test_count; i++) {
    const test_t *test = &test_table[i];
    if (strstr(test->file, word) || strstr(test->name, word)) run(test, &sum);
    const bool last_of_file = i + 1 == test_count || strcmp(test->file, test_table[i + 1].file) != 0;
    const int ran = sum.passed + sum.failed - file.passed - file.failed;
    if (last_of_file && ran > 0)
      printf("%-28s %4d passed %4d failed\n", test->file, sum.passed - file.passed, sum.failed - file.failed);
    if (last_of_file) file = sum;
  }
  if (sum.skipped) printf("%d skipped\n", sum.skipped);
  printf("%d passed, %d failed\n", sum.passed, sum.failed);
  return sum.failed > 0 || sum.passed == 0;
}
