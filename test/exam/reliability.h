// reliability.h - the reliability diagram: names binned by the probability stated with them, against the
// share that was right. tools/outside/reliability.py does the same for flights of another simulator.
#ifndef TEST_EXAM_RELIABILITY_H
#define TEST_EXAM_RELIABILITY_H

#include <stdbool.h>
#include <stdio.h>

#define RELIABILITY_BINS 4 // beginning at 0, 0.5, 0.8 and 0.95
#define RELIABILITY_SURE (RELIABILITY_BINS - 1)

typedef struct {
  struct {
    int of, right;
    double stated; // sum of the stated probabilities
  } bin[RELIABILITY_BINS];
  int unstated; // names without a probability
} reliability_t;

// Adds one name. stated: 0..1; NaN: none was stated.
void reliability_add(reliability_t *r, double stated, bool right);
void reliability_join(reliability_t *r, const reliability_t *other);

// 90 % confidence interval of a share, from `right` of `of` (more than none): Wilson 1927, score interval.
void reliability_interval(int right, int of, double *from, double *to);

// Prints a line for each bin: mean stated probability, share that was right, and its interval.
void reliability_print(const reliability_t *r, FILE *out);

#endif
