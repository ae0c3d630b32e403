// test_gap_fitness.c - what is said of the flights themselves.
#include "gap/8_report/report.h"
#include "rig/test.h"

#include <stdlib.h>
#include <string.h>

// Kinds in which a sag is a scale of the thrust are as many groups; they are told as one.
TEST(gap_tells_once_what_these_flights_cannot_tell_apart) {
  static const char *const name[] = {"thrust_scale", "battery_sag", "thrust_scale",
                                     "battery_sag",  "accel_bias",  "mass",
                                     "wind",         "mass",        "wind"};
  enum { N = sizeof name / sizeof *name };
  int alike[N] = {0, 0, 2, 2, 4, 4, 4, 7, 7};
  candidate_t candidate[N];
  study_t *const study = calloc(1, sizeof *study);
  report_t *const r = calloc(1, sizeof *r);
  why_t why;
  for (int i = 0; i < N; i++)
    candidate[i] = (candidate_t){.use = fx_use(fx_find(name[i])), .first = i, .n = 1};
  study->vehicle.ceiling_m = 0.5;
  study->diagnosis.candidates = (candidates_t){.candidate = candidate, .n = N, .columns = N};
  study->diagnosis.found.alike = alike;
  r->study = study;
  CHECK_OK(report_take_fitness(r, &why));
  const char *const told = r->fitness.line[r->fitness.n - 1];
  CHECK_TEXT(
      told,
      "not told apart at typical size: thrust_scale = battery_sag; accel_bias = mass = wind; mass = wind");
  free(study);
  free(r);
}
