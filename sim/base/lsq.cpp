// lsq.cpp - linear least squares.
#include "base/lsq.h"

#include "base/dense.hpp"

void lsq_solve(int rows, int columns, const double *A, const double *b, double *x) {
  using by_row = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  Eigen::Map<VectorXd>(x, columns) =
      dense_least_squares(by_row(A, rows, columns), Eigen::Map<const VectorXd>(b, rows));
}
