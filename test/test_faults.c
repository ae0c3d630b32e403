// test_faults.c - HEAD
#include "faults.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FIRST_SEED 1000u
#define ROWS_MAX   64
#define GAPS_MAX   8

typedef struct {
  int passed;
  double gap_m;
  const char *why;
} tally_t;

static int all_rows(const row_t *out[ROWS_MAX]) {
  const rows_t part[] = {faults_of_motion(), faults_of_range(), faults_of_vehicle(), faults_of_state()};
  const char *only = getenv("FAULTS_ROW");
  int n = 0;
  for (int k = 0; k < 4; k++)
    for (int i = 0; i < part[k].n && n < ROWS_MAX; i++)
      if (!only || strncmp(part[k].row[i].name, only, strlen(only)) == 0) out[n++] = &part[k].row[i];
  return n;
}

// The fault-free flights of one seed, one for each gap.
typedef struct {
  double gap_m[GAPS_MAX];
  flown_fault_t flown[GAPS_MAX];
  int n;
} usual_t;

static flown_fault_t usual_of(usual_t *u, case_t *c, const row_t *row, uint64_t seed) {
  for (int i = 0; i < u->n && !row->same_bits; i++)
    if (u->gap_m[i] == row->gap_m) return u->flown[i];
  faults_fly(c, row, seed, true);
  if (!row->same_bits && u->n < GAPS_MAX) {
    u->gap_m[u->n] = row->gap_m;
    u->flown[u->n++] = c->seen;
  }
  return c->seen;
}

static void fly_seed(const row_t *const rows[], int n, uint64_t seed, tally_t tally[], const char *tell) {
  case_t *c = malloc(sizeof *c);
  usual_t u = {.n = 0};
  for (int k = 0; k < n; k++) {
    const flown_fault_t usual = usual_of(&u, c, rows[k], seed);
    faults_fly(c, rows[k], seed, false);
    const char *failed = faults_judge(c, &usual);
#pragma omp critical
    {
      tally[k].passed += failed == NULL;
      tally[k].gap_m = fmin(tally[k].gap_m, c->seen.gap_min_m);
      if (failed) tally[k].why = failed;
      if (tell && (tell[0] == '3' || (failed && tell[0] == '2')))
        faults_tell(c, seed, failed ? failed : "ok", &usual);
    }
  }
  free(c);
}

TEST(faults_of_the_list_end_as_they_should) {
  const char *tell = getenv("FAULTS_TABLE"), *many = getenv("FAULTS_SEEDS");
  const int seeds = many ? atoi(many) : test_long() ? 1000 : 20;
  const row_t *rows[ROWS_MAX];
  const int n = all_rows(rows);
  tally_t tally[ROWS_MAX];
  for (int k = 0; k < n; k++) tally[k] = (tally_t){.gap_m = HUGE_VAL, .why = ""};
#pragma omp parallel for schedule(dynamic, 1)
  for (int i = 0; i < seeds; i++) fly_seed(rows, n, FIRST_SEED + (uint64_t)i, tally, tell);
  for (int k = 0; k < n; k++) {
    if (tell)
      printf("%-36s %c %5.1f %% of %d, nearest %.1f mm  %s\n", rows[k]->name, rows[k]->cls,
             100.0 * tally[k].passed / seeds, seeds, 1e3 * tally[k].gap_m, tally[k].why);
    ROW("%s: %d of %d (%s)", rows[k]->name, tally[k].passed, seeds, tally[k].why);
    CHECK(tally[k].passed * 100.0 >= rows[k]->promise * seeds);
  }
}

TEST(faults_of_ten_minutes_in_one_place_teach_nothing_wrong) {
  const int seeds = test_long() ? 20 : 2;
  const row_t *row = faults_of_patience().row;
  for (int i = 0; i < seeds; i++) {
    case_t *c = malloc(sizeof *c);
    ROW("seed %d", i);
    faults_fly(c, row, FIRST_SEED + (uint64_t)i, false);
    const char *failed = faults_judge(c, &c->seen);
    CHECK_TEXT(failed ? failed : "kept", "kept");
    CHECK(c->seen.gap_min_m > 0.01);
    free(c);
  }
}
