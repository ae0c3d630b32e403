// reliability.h - the reliability diagram: names by the probability that was stated with them, against the
// share of them that was right. tools/outside/reliability.py is the same for flights of another simulator.
#ifndef TEST_EXAM_RELIABILITY_H
#define TEST_EXAM_RELIABILITY_H

#include <stdbool.h>
#include <stdio.h>

#define RELIABILITY_BINS 4 // from 0, 0.5, 0.8 and 0.95 on
#define RELIABILITY_SURE (RELIABILITY_BINS - 1)

typedef struct {
  struct {
    int of, right;
    double stated; // sum of what was stated
  } bin[RELIABILITY_BINS];
  int unstated; // names without a probability
} reliability_t;

// One name. stated: 0..1; NaN: none was stated.
void reliability_add(reliability_t *r, double stated, bool right);
void reliability_join(reliability_t *r, const reliability_t *other);

// 90 % of the shares that `right` of `of` (more than none) may stand for: Wilson 1927, score interval.
void reliability_interval(int right, int of, double *from, double *to);

// A line for each bin: mean of what was stated, share that was right, its interval.
void reliability_print(const reliability_t *r, FILE *out);

#endif
