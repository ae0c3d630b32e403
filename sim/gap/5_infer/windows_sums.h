// windows_sums.h - products of the indicator columns of bins with each other and with a residual, all white,
// for one channel or for several side by side. Before it is included, define SUMS_NUMBER (one number or
// four) and SUMS_BINS (how many bins there are at most). Within sim/gap/5_infer only.
#ifndef SIM_GAP_5_INFER_WINDOWS_SUMS_H
#define SIM_GAP_5_INFER_WINDOWS_SUMS_H

#include "base/wide.h"
#include "gap/2_predict/color.h"

#ifndef SUMS_NUMBER
#define SUMS_NUMBER double
#define SUMS_BINS   1
#endif
typedef SUMS_NUMBER number_t;

typedef struct {
  int bins; // number `bins`, after them, is the constant
  number_t D[SUMS_BINS + 1][SUMS_BINS + 1], y[SUMS_BINS + 1];
} products_t;

// White weights of a row and the two before it, and their products.
typedef struct {
  number_t of[3], constant, pair[3][3], crossed[3];
} weights_t;

static inline void weights_multiply(weights_t *w) {
  w->constant = w->of[0] + w->of[1] + w->of[2];
  for (int a = 0; a < 3; a++) {
    w->crossed[a] = w->of[a] * w->constant;
    for (int b = 0; b < 3; b++) w->pair[a][b] = w->of[a] * w->of[b];
  }
}

// Adds a row and the two before it, each in its bin.
WIDE_INLINE void sums_add_row(products_t *p, const weights_t *w, const number_t *white, const int *bin) {
  for (int a = 0; a < 3; a++) {
    const int k = bin[-a];
    p->y[k] += w->of[a] * *white;
    p->D[k][p->bins] += w->crossed[a];
    for (int b = 0; b < 3; b++) p->D[k][bin[-b]] += w->pair[a][b];
  }
}

// The same where all three are in one bin, as most are: each number is loaded and stored once.
WIDE_INLINE void sums_add_row_of_one(products_t *p, const weights_t *w, const number_t *white, int k) {
  number_t y = p->y[k], cross = p->D[k][p->bins], own = p->D[k][k];
  for (int a = 0; a < 3; a++) {
    y += w->of[a] * *white;
    cross += w->crossed[a];
    for (int b = 0; b < 3; b++) own += w->pair[a][b];
  }
  p->y[k] = y;
  p->D[k][p->bins] = cross;
  p->D[k][k] = own;
}

// Sums up all rows. v: one number_t for each row.
WIDE_INLINE void sums_of(products_t *p, int bins, const rows_t *r, const weights_t *w, const double *v,
                         const int *bin) {
  const int each = (int)(sizeof(number_t) / sizeof(double));
  p->bins = bins;
  for (int k = 0; k <= bins; k++) memset(p->D[k], 0, ((size_t)bins + 1) * sizeof(number_t));
  memset(p->y, 0, ((size_t)bins + 1) * sizeof(number_t));
  for (int i = 2; i < r->n; i++) {
    if (!color_reaches(r, i)) continue;
    number_t at[3];
    for (int a = 0; a < 3; a++) memcpy(&at[a], v + each * (i - a), sizeof at[a]);
    const number_t white = w->of[0] * at[0] + w->of[1] * at[1] + w->of[2] * at[2];
    if (bin[i] == bin[i - 1] && bin[i] == bin[i - 2])
      sums_add_row_of_one(p, w, &white, bin[i]);
    else
      sums_add_row(p, w, &white, bin + i);
    p->y[bins] += w->constant * white;
    p->D[bins][bins] += w->constant * w->constant;
  }
}

#endif
