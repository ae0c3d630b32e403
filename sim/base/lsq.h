// lsq.h - linear least squares (Eigen behind a C header).
#ifndef SIM_BASE_LSQ_H
#define SIM_BASE_LSQ_H

#ifdef __cplusplus
extern "C" {
#endif

// x (columns) that minimises |A x - b|; where several do, the shortest. A: rows x columns, row by row.
void lsq_solve(int rows, int columns, const double *A, const double *b, double *x);

#ifdef __cplusplus
}
#endif

#endif
