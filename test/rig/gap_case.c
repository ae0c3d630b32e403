// gap_case.c - flights in which effects are hidden, diagnosed.
#include "rig/gap_case.h"

#include "rig/test.h"
#include <stdlib.h>

#define DRAWS 5

fx_use_t gap_effect(const char *name, double p0, double p1) {
  fx_use_t use = fx_use(fx_find(name));
  use.p[0] = p0;
  if (use.fx->n_param > 1 || use.form) use.p[1] = p1;
  return use;
}

void gap_case_fly(exam_flight_t job, gap_flight_t *flight) {
  why_t why = {""};
  done_t flew = exam_fly(&job, flight, &why);
  for (int k = 1; k < DRAWS && flew != DONE; k++) {
    gap_flight_free(flight);
    job.seed += 1000;
    flew = exam_fly(&job, flight, &why);
  }
  CHECK_OK(flew);
}

static void fly(gap_case_t *c, int i, const gap_hidden_t *hidden, uint64_t seed) {
  model_t truth = c->given;
  why_t why;
  for (int k = 0; k < hidden->n; k++) CHECK_OK(model_add_fx(&truth, &hidden->use[k], &why));
  const exam_flight_t job = {.truth = &truth, .seed = seed + (unsigned long)i};
  gap_case_fly(job, &c->flight[i]);
}

gap_case_t *gap_case(const gap_hidden_t *fit, const gap_hidden_t *held) {
  return gap_case_of_seed(fit, held, 70);
}

gap_case_t *gap_case_of_seed(const gap_hidden_t *fit, const gap_hidden_t *held, uint64_t seed) {
  gap_case_t *const c = calloc(1, sizeof *c);
  why_t why;
  if (!c) abort();
  CHECK_OK(exam_vehicle(&c->given, &why));
  for (int i = 0; i <= GAP_CASE_FIT; i++) fly(c, i, i < GAP_CASE_FIT ? fit : held, seed);
  const gap_flights_t to_fit = {c->flight, GAP_CASE_FIT}, kept = {c->flight + GAP_CASE_FIT, 1};
  const diagnose_job_t job = {.fit = &to_fit, .held = &kept, .model = &c->given, .seed = 1};
  CHECK_OK(diagnose(&job, &c->d, &why));
  return c;
}

void gap_case_free(gap_case_t *c) {
  diagnosis_free(&c->d);
  for (int i = 0; i <= GAP_CASE_FIT; i++) gap_flight_free(&c->flight[i]);
  free(c);
}

const named_t *gap_case_named(const gap_case_t *c, const char *name) {
  for (int i = 0; i < c->d.found.n; i++)
    if (found_use(&c->d.found, &c->d.found.named[i])->fx == fx_find(name)) return &c->d.found.named[i];
  return NULL;
}
