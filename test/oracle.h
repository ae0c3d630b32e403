// oracle.h - linear algebra in double by Eigen: what the flight code's own is compared with.
#ifndef TEST_ORACLE_H
#define TEST_ORACLE_H

#ifdef __cplusplus
extern "C" {
#endif

#define ORACLE_N 7

// The x that makes |A x - y| smallest; A has n >= ORACLE_N rows and full rank.
void oracle_least_squares(int n, const double (*A)[ORACLE_N], const double *y, double x[ORACLE_N]);

// The eigenvalues of a symmetric matrix, the smallest first. Only the lower triangle is read.
void oracle_eigenvalues(const double A[ORACLE_N][ORACLE_N], double values[ORACLE_N]);

#ifdef __cplusplus
}
#endif

#endif
