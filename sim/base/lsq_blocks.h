// lsq_blocks.h - least squares from sums of products (Eigen and Boost.Math behind a C header, but for the
// sums).
//
// A sum of products G has n + 1 rows and columns, row by row: those of the n regressors and, last, of what
// they are to explain.
#ifndef SIM_BASE_LSQ_BLOCKS_H
#define SIM_BASE_LSQ_BLOCKS_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Adds the products of some columns to one half of G, where a column meets itself or a later one. X: column
// number j starts at X[j], `rows` numbers; column[j]: which one of G it is, in their order. also: gets them
// too, or null. Four rows at a time, with the same bits (lsq_products.c). False: no memory.
bool lsq_add_products(int rows, int n, const double *const *X, const int *column, int size, double *G,
                      double *also);

// When all are added: the other half is the same.
void lsq_mirror(double *G, int size);

// The best b (n numbers) for the regressors column[0..n-1] of G, whose size is `size` (the last is
// explained). ridge (a null pointer for none): is added to the diagonal, by regressor of G. inverse: n x n,
// or null. Returns the sum of squares that is left (without the ridge's share).
double lsq_solve_products(const double *G, int size, const int *column, int n, const double *ridge, double *b,
                          double *inverse);

// What b leaves of the sum of squares in G.
double lsq_left(const double *G, int size, const int *column, int n, const double *b);

// b' V^-1 b for n numbers; HUGE_VAL if V is singular.
double lsq_wald(const double *b, const double *V, int n);

// Probability of an F-distributed number above f.
double lsq_f_above(double f, double n1, double n2);

// The value that it exceeds with probability p.
double lsq_f_quantile(double p, double n1, double n2);

// The value that a Student-distributed number exceeds with probability p.
double lsq_t_quantile(double p, double n);

#ifdef __cplusplus
}
#endif

#endif
