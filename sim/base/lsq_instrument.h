// lsq_instrument.h - two-stage least squares from sums of products (Eigen behind a C header).
//
// Columns of G: n regressors X, then for each of them in turn its instruments Z_k, `sets` times `lags`, and
// last y. A set that alone is too weak (F below `least`) is left out. First stage: xhat_k = Z_k (Z_k' Z_k)^-1
// Z_k' x_k; second: b = (Xhat' X)^-1 Xhat' y. Covariances, of b and of b less plain least squares
// (Hausman's test, robust), are jackknifed over the blocks: a few of these often have nearly all that the
// reference does, and the usual sandwich is too small then. The plain ones may be of other sums, over the
// same blocks: of regressors that were measured better, where instruments need no better ones.
//
// Strength of a first stage: F = gamma^2/var(gamma) over the number of instruments, gamma the slope of x_k on
// the combination of Xhat that is orthogonal to all other regressors. Where it is below `least`, x_k stands
// for itself: it is told as weak, and does not spoil the others.
#ifndef SIM_BASE_LSQ_INSTRUMENT_H
#define SIM_BASE_LSQ_INSTRUMENT_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  const double *total, *block; // n_block matrices; total is their sum
  int n_block, n, sets, lags;
  double least; // F from which an instrument is one
  const double *plain_total,
      *plain_block; // of the n regressors and y for plain least squares; null: of these
} lsq_instrument_t;

// n numbers each.
typedef struct {
  double *plain, *b, *F;
  double *blocks;    // how many of equal weight would say as much, where F is enough
  double *V, *apart; // n x n
} lsq_instrumented_t;

// False: there is no solution.
bool lsq_instrument(const lsq_instrument_t *p, const lsq_instrumented_t *out);

#ifdef __cplusplus
}
#endif

#endif
