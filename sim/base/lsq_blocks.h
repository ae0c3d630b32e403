// lsq_blocks.h - least squares from sums of products (Eigen and Boost.Math behind a C header, except for the
// sums).
//
// A matrix G of sums of products is stored row by row. It has n + 1 rows and columns: the n regressors and,
// last, the dependent variable.
#ifndef SIM_BASE_LSQ_BLOCKS_H
#define SIM_BASE_LSQ_BLOCKS_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Adds the products of some columns to G's upper triangle with the diagonal. X: column number j starts at
// X[j] and has `rows` numbers; column[j] is its index in G, in ascending order. also: a second matrix that
// gets the same products, or null. The result has the same bits as four rows at a time (lsq_products.c).
// False if there is no memory.
bool lsq_add_products(int rows, int n, const double *const *X, const int *column, int size, double *G,
                      double *also);

// Copies the upper triangle into the lower one, once all products are added.
void lsq_mirror(double *G, int size);

// Sets b (n numbers) to the least-squares coefficients of the regressors column[0..n-1] of G, which has
// `size` rows. ridge: is added to the diagonal, indexed as G's regressors; null for none. inverse: that of
// the n x n normal matrix, or null. Returns the residual sum of squares (without the ridge's share).
double lsq_solve_products(const double *G, int size, const int *column, int n, const double *ridge, double *b,
                          double *inverse);

// The residual sum of squares in G with the coefficients b.
double lsq_left(const double *G, int size, const int *column, int n, const double *b);

// The Wald statistic b' V^-1 b for n numbers; HUGE_VAL if a diagonal element of V is not positive.
double lsq_wald(const double *b, const double *V, int n);

// The probability that an F-distributed number exceeds f.
double lsq_f_above(double f, double n1, double n2);

// The value that an F-distributed number exceeds with probability p.
double lsq_f_quantile(double p, double n1, double n2);

// The value that a Student-distributed number exceeds with probability p.
double lsq_t_quantile(double p, double n);

#ifdef __cplusplus
}
#endif

#endif
