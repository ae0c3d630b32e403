// cholesky.h - a symmetric, positive matrix as L L' (Eigen behind a C header).
//
// Matrices are n x n, row by row; of L the half below the diagonal counts, with it.
#ifndef SIM_BASE_CHOLESKY_H
#define SIM_BASE_CHOLESKY_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// A becomes L, whose other half keeps what it had. False: A is not positive, or not finite; it is
// overwritten.
bool cholesky(double *A, int n);

// b becomes L^-1 b, and L'^-1 b.
void cholesky_forward(const double *L, int n, double *b);
void cholesky_backward(const double *L, int n, double *b);

#ifdef __cplusplus
}
#endif

#endif
