// main.c - runs an exam of many sets and prints the marks: main FIRST_SEED SETS [lines [KIND]], or, with
// users' logs, main users FIRST_SEED SETS [lines [KIND]].
#include "base/made.h"
#include "base/threads.h"
#include "exam/exam.h"
#include "exam/users.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SETS_MAX 4000

static const char *const KIND[EXAM_KINDS] = {"nothing", "one", "two", "strange", "hover"};

static void print_line(unsigned long seed, const exam_set_t *s) {
  char hidden[160] = "";
  if (s->kind == EXAM_STRANGE) snprintf(hidden, sizeof hidden, "%s", s->strange.what);
  for (int k = 0; k < s->n; k++) {
    const size_t used = k ? 80 : 0;
    snprintf(hidden + used, 80, "%s%s x%.2f", k ? " + " : "", s->hidden[k], s->times[k]);
  }
  if (s->n == 2) {
    char both[160];
    snprintf(both, sizeof both, "%s%s", hidden, hidden + 80);
    snprintf(hidden, sizeof hidden, "%s", both);
  }
  char told[80] = "";
  for (int k = 0; k < s->n; k++)
    snprintf(told + strlen(told), sizeof told - strlen(told), " told x%.2f", s->least[k]);
  char unknown[80] = "";
  if (s->unknown)
    snprintf(unknown, sizeof unknown, " UNKNOWN%s %s at %s %.3g to %.3g", s->unknown_right ? "(right)" : "",
             gap_channel[s->cell.channel], s->cell.coordinate, s->cell.from, s->cell.to);
  printf("%lu %s%s: %s -> %s%s%s%s after %.3f oracle %.3f\n", seed, KIND[s->kind], s->own_form ? "*" : "",
         hidden, s->answer, unknown,
         !s->flew          ? " CRASHED"
         : s->wrong        ? " WRONG"
         : s->found < s->n ? " MISSED"
                           : "",
         told, s->after, s->oracle);
  for (int i = 0; i < s->n_value; i++)
    printf("    %s.%s %.4g: %.4g +- %.2g, %+.1f standard errors\n", s->value[i].name, s->value[i].param,
           s->value[i].truth, s->value[i].value, s->value[i].stderr_,
           (s->value[i].value - s->value[i].truth) / s->value[i].stderr_);
}

typedef struct {
  int n, yes;
} rate_t;

static void count(rate_t *r, bool yes) {
  r->n++;
  r->yes += yes;
}

static void print_rate(const char *what, const rate_t *r) {
  printf("%-62s %4d/%-4d %5.1f %%\n", what, r->yes, r->n, r->n ? 100.0 * r->yes / r->n : 0.0);
}

typedef struct {
  rate_t alarm, band[4], two, two_large, rival, strange, located, hover, hover_says, large, large_own,
      unknown_wrong;
  rate_t recall, precision, hover_recall, values, promise, too_large;
  reliability_t stated;
  double after, oracle;
  int shrunk, no_rows, drawn_again;
} marks_t;

static void add_one(marks_t *m, const exam_set_t *s) {
  const double times = s->times[0];
  count(&m->band[times < 0.5 ? 0 : times < 1.0 ? 1 : times < 2.0 ? 2 : 3], s->exact);
  if (times >= 1.0) count(s->own_form ? &m->large_own : &m->large, s->exact);
}

// Where one effect is hidden: compares the smallest visible size that was told with the answer.
static void add_told(marks_t *m, const exam_set_t *s) {
  if (s->n != 1) return;
  if (s->least[0] <= s->times[0]) count(&m->promise, s->found == 0);
  if (s->found == 1) count(&m->too_large, s->least[0] > s->times[0]);
}

static void add(marks_t *m, const exam_set_t *s) {
  m->drawn_again += s->drawn_again;
  if (!s->flew) return;
  for (int i = 0; i < s->n_value; i++) count(&m->values, exam_holds(&s->value[i]));
  reliability_join(&m->stated, &s->stated);
  add_told(m, s);
  if (s->kind == EXAM_NOTHING) count(&m->alarm, s->wrong > 0);
  if (s->kind == EXAM_NOTHING) count(&m->unknown_wrong, s->unknown);
  if (s->kind == EXAM_ONE) add_one(m, s);
  if (s->kind == EXAM_TWO) count(&m->two, s->exact);
  if (s->kind == EXAM_TWO && fmin(s->times[0], s->times[1]) >= 1.0) count(&m->two_large, s->exact);
  if (s->kind == EXAM_STRANGE) {
    count(&m->strange, s->wrong == 0);
    if (s->unknown) count(&m->located, s->unknown_right);
  }
  if (s->kind == EXAM_HOVER) {
    count(&m->hover, s->wrong == 0);
    if (s->found < s->n) count(&m->hover_says, s->says_not_testable);
    count(&m->hover_recall, s->found == s->n);
  }
  if (s->kind != EXAM_ONE && s->kind != EXAM_TWO) return;
  for (int k = 0; k < s->n; k++)
    if (s->found + s->wrong > 0 && s->times[k] >= 1.0) count(&m->rival, s->rival_held[k]);
  for (int k = 0; k < s->n; k++) count(&m->recall, k < s->found);
  for (int k = 0; k < s->found + s->wrong; k++) count(&m->precision, k < s->found);
  m->after += s->after;
  m->oracle += s->oracle;
  m->shrunk += s->shrink_known;
  m->no_rows += !s->shrink_known;
}

static void print_marks(const marks_t *m) {
  static const char *const band[] = {"one effect, 0.25-0.5 x typical: exact",
                                     "one effect, 0.5-1 x typical: exact", "one effect, 1-2 x typical: exact",
                                     "one effect, 2-4 x typical: exact"};
  print_rate("nothing hidden: a name (goal: at most 5 %)", &m->alarm);
  print_rate("nothing hidden: unknown", &m->unknown_wrong);
  for (int i = 0; i < 4; i++) print_rate(band[i], &m->band[i]);
  print_rate("one effect, at least typical, library form (goal: 95 %)", &m->large);
  print_rate("one effect, at least typical, the exam's own form (95 %)", &m->large_own);
  print_rate("two effects: exact", &m->two);
  print_rate("two effects, both at least typical: exact (goal: 80 %)", &m->two_large);
  print_rate("hidden effects that were named, all sizes", &m->recall);
  print_rate("names that were hidden", &m->precision);
  print_rate("a name, or its rivals, hold the truth (goal: 95 %)", &m->rival);
  print_rate("named, library form: a number within two standard errors", &m->values);
  print_rate("outside the library: no wrong name (goal: 90 %)", &m->strange);
  print_rate("outside the library, unknown said: channel, coordinate right", &m->located);
  print_rate("hover only: nothing wrong named", &m->hover);
  print_rate("hover only: named", &m->hover_recall);
  print_rate("hover only, not named: says it could not be tested", &m->hover_says);
  print_rate("one hidden, not smaller than told to be seen: not named", &m->promise);
  print_rate("one hidden and named: smaller than told to be seen", &m->too_large);
  const double n = fmax(m->shrunk, 1);
  printf("drawn again, because the vehicle could not fly: %d\n", m->drawn_again);
  printf("held-out sum of squares, after / with the truth (goal: 1.05)   %.3f / %.3f = %.3f\n", m->after / n,
         m->oracle / n, m->oracle > 0.0 ? m->after / m->oracle : 0.0);
  printf("  left out of it, because the held-out flight has no row to compare: %d\n", m->no_rows);
  printf("names of all sets, by the probability stated; right: it, or a rival that is told, was hidden\n");
  reliability_print(&m->stated, stdout);
}

int main(int argc, char **argv) {
  static exam_set_t sets[SETS_MAX];
  threads_sleep(argv);
  if (argc == 2 && strcmp(argv[1], "--version") == 0) {
    made_version("exam");
    return 0;
  }
  if (argc > 1 && strcmp(argv[1], "users") == 0) return users_main(argc - 1, argv + 1);
  const unsigned long first = argc > 1 ? strtoul(argv[1], NULL, 10) : 1;
  const int n = argc > 2 ? atoi(argv[2]) : 20, only = argc > 4 ? atoi(argv[4]) : -1;
  if (n < 1 || n > SETS_MAX) return 2;
#pragma omp parallel for schedule(dynamic, 1)
  for (int i = 0; i < n; i++) {
    why_t why;
    const exam_kind_t kind = only >= 0 ? (exam_kind_t)only : exam_kind(i);
    if (exam_one(kind, first + (unsigned long)i, &sets[i], &why) != DONE) {
      fprintf(stderr, "exam: set %lu: %s\n", first + (unsigned long)i, why.text);
      sets[i].flew = false;
    }
  }
  static marks_t marks;
  for (int i = 0; i < n; i++) {
    if (argc > 3) print_line(first + (unsigned long)i, &sets[i]);
    add(&marks, &sets[i]);
  }
  print_marks(&marks);
  return 0;
}
