// gap_case.h - flights of the exam's vehicle with hidden effects, and what the workflow says of them.
#ifndef TEST_RIG_GAP_CASE_H
#define TEST_RIG_GAP_CASE_H

#include "exam/flights.h"
#include "gap/diagnose.h"

#define GAP_CASE_FIT 2 // flights to fit; one more is held out

// Effects that are hidden together.
typedef struct {
  int n;
  fx_use_t use[2];
} gap_hidden_t;

typedef struct {
  model_t given;
  gap_flight_t flight[GAP_CASE_FIT + 1];
  diagnosis_t d;
} gap_case_t;

// An effect of sim/effects with these first parameters; the others are nominal.
fx_use_t gap_effect(const char *name, double p0, double p1);

// Flies one. A vehicle near its limits may crash by chance: then it flies again with another seed.
void gap_case_fly(exam_flight_t job, gap_flight_t *flight);

// Flies and diagnoses; the held-out flight may hide something else.
gap_case_t *gap_case(const gap_hidden_t *fit, const gap_hidden_t *held);
// The same with other seeds: this one and the next GAP_CASE_FIT.
gap_case_t *gap_case_of_seed(const gap_hidden_t *fit, const gap_hidden_t *held, uint64_t seed);
void gap_case_free(gap_case_t *c);

// The name that the workflow gave for this effect; null: none.
const named_t *gap_case_named(const gap_case_t *c, const char *name);

#endif
