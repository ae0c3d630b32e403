// cholesky.h - Cholesky factor of a symmetric positive definite matrix, L L' (Eigen behind a C header).
//
// Matrices are n x n, row by row. Of L, the lower triangle with the diagonal is used.
#ifndef SIM_BASE_CHOLESKY_H
#define SIM_BASE_CHOLESKY_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Replaces A's lower triangle by L; the upper one stays. False if A is not positive definite or not finite; A
// is then overwritten, too.
bool cholesky(double *A, int n);

// Replaces b by L^-1 b, and by L'^-1 b.
void cholesky_forward(const double *L, int n, double *b);
void cholesky_backward(const double *L, int n, double *b);

#ifdef __cplusplus
}
#endif

#endif
