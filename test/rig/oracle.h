// oracle.h - references to compare our own code with: eigenvalues in double, and the C++ library's random
// numbers.
#ifndef TEST_RIG_ORACLE_H
#define TEST_RIG_ORACLE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ORACLE_N 7

// The eigenvalues of a symmetric matrix, the smallest first. Only the lower triangle is read.
void oracle_eigenvalues(const double A[ORACLE_N][ORACLE_N], double values[ORACLE_N]);

// n numbers from 0 to 1 of std::mt19937_64.
void oracle_uniform(uint64_t seed, int n, double *out);
// n normal numbers of the same generator.
void oracle_normal(uint64_t seed, int n, double *out);

#ifdef __cplusplus
}
#endif

#endif
