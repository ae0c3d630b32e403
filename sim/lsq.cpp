// lsq.cpp - linear least squares by a complete orthogonal decomposition.
#include "lsq.h"

#include <Eigen/Dense>

void lsq_solve(int rows, int columns, const double *A, const double *b, double *x) {
  using matrix_t = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const matrix_t> A_(A, rows, columns);
  const Eigen::Map<const Eigen::VectorXd> b_(b, rows);
  Eigen::Map<Eigen::VectorXd>(x, columns) = A_.completeOrthogonalDecomposition().solve(b_);
}
