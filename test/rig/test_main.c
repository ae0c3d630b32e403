// test_main.c - runs the tests whose file or name contains the word given as first argument. Each file runs
// in a process of its own, as many at once as there are cores; their output is printed in order.
#define _XOPEN_SOURCE 700 // fileno
#include "rig/test.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/times.h>
#include <sys/wait.h>
#include <unistd.h>

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

bool test_status(const char *file, int line, const char *what, int want, int got) {
  if (got == want) return true;
  report(file, line);
  printf("%s = status %d, want %d\n", what, got, want);
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

// Processor time in seconds, of this process and of the programs that it ran.
static double used_s(void) {
  struct tms t;
  times(&t);
  return (double)(t.tms_utime + t.tms_stime + t.tms_cutime + t.tms_cstime) / (double)sysconf(_SC_CLK_TCK);
}

static void run(const test_t *test, tally_t *sum) {
  const double before_s = used_s();
  row[0] = '\0';
  failures = 0;
  skipped = NULL;
  test->run();
  if (getenv("TIMES")) fprintf(stderr, "%7.2f s %s\n", used_s() - before_s, test->name);
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

static bool is_wanted(const test_t *test, const char *word) {
  return strstr(test->file, word) || strstr(test->name, word);
}

// The tests of one file: from `first` up to, not including, `end`.
typedef struct {
  int first, end;
  pid_t process; // 0: it has ended
  int status;
  FILE *output;
  int told[2]; // a pipe through which the process sends its tally
} job_t;

static tally_t run_file(int first, int end, const char *word) {
  tally_t sum = {0};
  for (int i = first; i < end; i++)
    if (is_wanted(&test_table[i], word)) run(&test_table[i], &sum);
  if (sum.passed + sum.failed > 0)
    printf("%-28s %4d passed %4d failed\n", test_table[first].file, sum.passed, sum.failed);
  fflush(stdout);
  return sum;
}

static void start(job_t *job, const char *word) {
  job->output = tmpfile();
  if (!job->output || pipe(job->told) != 0) abort();
  fflush(stdout);
  job->process = fork();
  if (job->process < 0) abort();
  if (job->process > 0) {
    close(job->told[1]);
    return;
  }
  if (dup2(fileno(job->output), STDOUT_FILENO) < 0) abort();
  const tally_t sum = run_file(job->first, job->end, word);
  if (write(job->told[1], &sum, sizeof sum) != sizeof sum) abort();
  exit(0);
}

static void wait_for_one(job_t *job, int n) {
  int status;
  const pid_t process = wait(&status);
  for (int i = 0; i < n; i++) {
    if (job[i].process != process) continue;
    job[i].process = 0;
    job[i].status = status;
  }
}

static void tell(job_t *job, tally_t *sum) {
  char text[4096];
  tally_t own;
  const bool told = read(job->told[0], &own, sizeof own) == sizeof own;
  rewind(job->output);
  for (size_t n; (n = fread(text, 1, sizeof text, job->output)) > 0;) fwrite(text, 1, n, stdout);
  fclose(job->output);
  close(job->told[0]);
  if (!told || job->status != 0) {
    printf("%s: died (status %d)\n", test_table[job->first].file, job->status);
    own = (tally_t){.failed = 1};
  }
  fflush(stdout);
  sum->passed += own.passed;
  sum->failed += own.failed;
  sum->skipped += own.skipped;
}

// Lists the files that have a wanted test; returns their number.
static int list_jobs(job_t *job, const char *word) {
  int n = 0;
  for (int i = 0; i < test_count; i++) {
    const bool opens = i == 0 || strcmp(test_table[i].file, test_table[i - 1].file) != 0;
    if (opens && (n == 0 || job[n - 1].end > 0)) n++;
    if (opens) job[n - 1] = (job_t){.first = i};
    job[n - 1].end = is_wanted(&test_table[i], word) || job[n - 1].end ? i + 1 : 0;
  }
  return n > 0 && job[n - 1].end == 0 ? n - 1 : n;
}

int main(int argc, char **argv) {
  const char *word = argc > 1 ? argv[1] : "";
  const long cores = sysconf(_SC_NPROCESSORS_ONLN);
  job_t *const job = calloc((size_t)test_count + 1, sizeof *job);
  tally_t sum = {0};
  if (!job) abort();
  const int n = list_jobs(job, word);
  if (n == 0) {
    fprintf(stderr, "tests: no test's file or name has the word `%s`\n", word);
    free(job);
    return 2;
  }
  for (int told = 0, begun = 0, running = 0; told < n;) {
    for (; begun < n && running < (cores > 1 ? cores : 1); running++) start(&job[begun++], word);
    wait_for_one(job, begun);
    running--;
    while (told < begun && job[told].process == 0) tell(&job[told++], &sum);
  }
  free(job);
  if (sum.skipped) printf("%d skipped\n", sum.skipped);
  printf("%d passed, %d failed\n", sum.passed, sum.failed);
  return sum.failed > 0 || sum.passed == 0;
}
