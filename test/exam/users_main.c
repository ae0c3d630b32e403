// users_main.c - runs the exam with users' logs; prints the marks of each kind and the reliability diagram.
#include "exam/users.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SETS_MAX 4000

static const char *const KIND[USERS_ALL] = {[USERS_HABITS] = "another simulator",
                                            [USERS_LADDER] = "ladder",
                                            [USERS_ALONE] = "one flight",
                                            [USERS_FILE] = "wrong file",
                                            [USERS_OUTSIDE] = "outside the library",
                                            [USERS_DIRTY] = "dirty",
                                            [USERS_SORTS] = "one sort a flight",
                                            [USERS_TORQUE] = "torque",
                                            [USERS_REFIT] = "fitted anew"};

static void print_set(unsigned long seed, const users_set_t *s) {
  printf("%lu %s:", seed, KIND[s->kind]);
  for (int k = 0; k < s->n; k++) printf(" %s x%.2f", s->hidden[k], s->times[k]);
  if (s->strange.what) printf(" %s", s->strange.what);
  if (s->cause) printf(" `%s`", s->cause);
  printf("%s -> %s%s\n", s->n || s->strange.what || s->cause ? "" : " nothing", s->answer,
         s->wrong                              ? " WRONG"
         : !s->strange.what && !users_exact(s) ? " MISSED"
                                               : "");
}

typedef struct {
  const char *what;
  int yes, of;
} rate_t;

static void print_rate(const rate_t *r) {
  if (r->of) printf("  %-58s %4d/%-4d %5.1f %%\n", r->what, r->yes, r->of, 100.0 * r->yes / r->of);
}

static reliability_t stated_in(users_kind_t kind, const users_set_t *set, int n) {
  reliability_t stated = {.unstated = 0};
  for (int i = 0; i < n; i++)
    if (set[i].kind == kind) reliability_join(&stated, &set[i].stated);
  return stated;
}

static void print_kind(users_kind_t kind, const users_set_t *set, int n) {
  rate_t alarm = {"nothing hidden: a name", 0, 0}, guess = {"nothing hidden: unknown", 0, 0};
  rate_t one = {"one effect, once to four times typical: exact", 0, 0}, two = {"two effects: exact", 0, 0};
  rate_t held = {"a name, or its rivals, hold what was hidden", 0, 0},
         names = {"names that were hidden", 0, 0};
  rate_t strange = {"outside the library: no name", 0, 0},
         located = {"outside the library: unknown, and where", 0, 0}, differ = {"flights differ: told", 0, 0};
  rate_t dirty = {"refused for the cause", 0, 0}, repaired = {"not refused, and no name", 0, 0};
  const reliability_t stated = stated_in(kind, set, n);
  rate_t refused = {"refused", 0, 0},
         sure = {"stated at 0.95 or more: right", stated.bin[RELIABILITY_SURE].right,
                 stated.bin[RELIABILITY_SURE].of};
  int lost = 0, unmet = 0;
  for (int i = 0; i < n; i++) {
    const users_set_t *const s = &set[i];
    if (s->kind != kind) continue;
    lost += s->lost, unmet += s->unmet;
    refused.of++, refused.yes += s->refused;
    names.of += s->names, names.yes += s->right + s->beside, held.of += s->n, held.yes += s->right;
    differ.of += s->differ, differ.yes += s->told_differ;
    if (s->cause) {
      dirty.of++, dirty.yes += users_exact(s), repaired.of++, repaired.yes += !s->refused && s->names == 0;
    } else if (s->strange.what) {
      strange.of++, strange.yes += s->names == 0 && !s->refused;
      located.of++, located.yes += s->located;
    } else if (s->n == 0) {
      alarm.of++, alarm.yes += s->names > 0, guess.of += !s->differ, guess.yes += !s->differ && s->unknown;
    } else {
      rate_t *const r = s->n == 1 ? &one : &two;
      r->of++, r->yes += users_exact(s);
    }
  }
  if (!refused.of) return;
  printf("%s, %d sets (drawn again: lost %d, never where it is hidden %d)\n", KIND[kind], refused.of, lost,
         unmet);
  const rate_t *const all[] = {&alarm,   &guess,  &one,   &two,      &held,    &names, &strange,
                               &located, &differ, &dirty, &repaired, &refused, &sure};
  for (unsigned i = 0; i < sizeof all / sizeof *all; i++) print_rate(all[i]);
}

int users_main(int argc, char **argv) {
  static users_set_t sets[SETS_MAX];
  const unsigned long first = argc > 1 ? strtoul(argv[1], NULL, 10) : 1;
  const int n = argc > 2 ? atoi(argv[2]) : 20, only = argc > 4 ? atoi(argv[4]) : -1;
  if (n < 1 || n > SETS_MAX || only >= USERS_ALL) return 2;
  bool failed = false;
#pragma omp parallel for schedule(dynamic, 1)
  for (int i = 0; i < n; i++) {
    why_t why;
    const int drawn = i % USERS_KINDS;
    const users_kind_t kind = (users_kind_t)(only >= 0 ? only : drawn + (drawn >= USERS_TORQUE));
    if (users_one(kind, first + (unsigned long)i, &sets[i], &why) != DONE) {
      fprintf(stderr, "exam: set %lu: %s\n", first + (unsigned long)i, why.text);
      failed = true;
    }
    if (argc > 3) {
#pragma omp critical
      print_set(first + (unsigned long)i, &sets[i]);
      fflush(stdout);
    }
  }
  reliability_t stated = {.unstated = 0};
  for (int k = 0; k < USERS_ALL; k++) {
    const reliability_t own = stated_in((users_kind_t)k, sets, n);
    print_kind((users_kind_t)k, sets, n);
    if (k != USERS_OUTSIDE && k != USERS_DIRTY) reliability_join(&stated, &own);
  }
  printf("names of all kinds but outside the library and dirty, by the probability stated\n");
  reliability_print(&stated, stdout);
  return failed;
}
