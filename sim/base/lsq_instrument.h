// lsq_instrument.h - two-stage least squares from sums of products (Eigen behind a C header).
//
// Columns of G: the n regressors X, then for each regressor its instruments Z_k (`sets` times `lags`), and
// last y. A set that is too weak by itself (F below `least`) is left out.
//
//   first stage   xhat_k = Z_k (Z_k' Z_k)^-1 Z_k' x_k
//   second stage  b = (Xhat' X)^-1 Xhat' y
//
// The covariances of b, and of b minus plain least squares (Hausman's test, robust), are jackknifed over the
// blocks: a few blocks often have nearly all of the reference's motion, and the usual sandwich estimate is
// then too small. Plain least squares may use other sums over the same blocks, with regressors that were
// measured better; instruments need no better ones.
//
// Strength of a first stage: F = gamma^2/var(gamma) over the number of instruments, where gamma is the slope
// of x_k on the combination of Xhat that is orthogonal to all other regressors. If F is below `least`, x_k
// stands for itself, so that it does not spoil the others; its F reports it as weak.
#ifndef SIM_BASE_LSQ_INSTRUMENT_H
#define SIM_BASE_LSQ_INSTRUMENT_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  const double *total, *block; // block: n_block matrices; total: their sum
  int n_block, n, sets, lags;
  double least; // smallest F of a usable instrument
  const double *plain_total,
      *plain_block; // for plain least squares: of the n regressors and y; null: as above
} lsq_instrument_t;

// n numbers each.
typedef struct {
  double *plain, *b, *F;
  double *blocks;    // effective number of blocks of equal weight, where F is large enough
  double *V, *apart; // n x n
} lsq_instrumented_t;

// False if there is no solution.
bool lsq_instrument(const lsq_instrument_t *p, const lsq_instrumented_t *out);

#ifdef __cplusplus
}
#endif

#endif
