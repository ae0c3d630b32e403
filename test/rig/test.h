// test.h - the whole of the test harness. TEST(a_sentence) { ... } is all it takes; the build collects them.
//
// A check that fails prints `file:line: row: expression = got, want x +- tol`, and the test goes on.
#ifndef TEST_RIG_TEST_H
#define TEST_RIG_TEST_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct {
  const char *file, *name;
  void (*run)(void);
} test_t;

extern const test_t test_table[]; // made by the build
extern const int test_count;

#define TEST(name) void test_##name(void)

// Names the row of a case table that the following checks belong to.
#define ROW(...) test_row(__VA_ARGS__)

#define CHECK(condition) test_check(__FILE__, __LINE__, #condition, (condition))
#define CHECK_NEAR(got, want, tol)                                                                           \
  test_near(__FILE__, __LINE__, #got, (double)(got), (double)(want), (double)(tol))
#define CHECK_OK(call)           test_status(__FILE__, __LINE__, #call, 0, (int)(call))
#define CHECK_STATUS(want, call) test_status(__FILE__, __LINE__, #call, (int)(want), (int)(call))
#define CHECK_TEXT(got, want)    test_text(__FILE__, __LINE__, #got, (got), (want))
// Ends the test without a result, and prints why.
#define SKIP(why)                                                                                            \
  do {                                                                                                       \
    test_skip(why);                                                                                          \
    return;                                                                                                  \
  } while (0)

void test_row(const char *format, ...) __attribute__((format(printf, 1, 2)));
bool test_check(const char *file, int line, const char *what, bool ok);
bool test_near(const char *file, int line, const char *what, double got, double want, double tol);
bool test_status(const char *file, int line, const char *what, int want, int got);
bool test_text(const char *file, int line, const char *what, const char *got, const char *want);
void test_skip(const char *why);

// The folder of measured data, from the environment variable DATA; a null pointer if there is none.
const char *test_data_dir(void);

// True in `make check`: tests may take minutes.
bool test_long(void);

// Number of rows of a slow table to run: all in `make check`, else the first few.
#define FEW_OR_ALL(table, few) (test_long() ? sizeof(table) / sizeof *(table) : (few))

#endif
