// increments.h - how alike what was measured and what was predicted are from row to row: what is slow does
// not count, and a scale shows as one.
#ifndef SIM_GAP_2_PREDICT_INCREMENTS_H
#define SIM_GAP_2_PREDICT_INCREMENTS_H

#include "gap/2_predict/residual.h"

// Sums of squares and products of the two's increments over n rows that follow one another.
typedef struct {
  double yy, pp, yp; // measured, predicted, both
  int n;
} increments_t;

static inline increments_t increments_of(const rows_t *r, const double *measured, const double *residual) {
  increments_t s = {.n = 0};
  for (int i = 1; i < r->n; i++) {
    if (!r->follows[i]) continue;
    const double y = measured[i] - measured[i - 1], p = y - (residual[i] - residual[i - 1]);
    s.yy += y * y;
    s.pp += p * p;
    s.yp += y * p;
    s.n++;
  }
  return s;
}

#endif
