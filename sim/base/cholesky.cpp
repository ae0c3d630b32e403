// cholesky.cpp - Cholesky factor of a symmetric positive definite matrix, by Eigen.
#include "base/cholesky.h"

#include <Eigen/Cholesky>

using rows_t = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool cholesky(double *A, int n) {
  Eigen::Map<rows_t> in_place(A, n, n);
  const Eigen::LLT<Eigen::Ref<rows_t>> llt(in_place);
  return llt.info() == Eigen::Success && in_place.diagonal().allFinite(); // LLT does not reject NaN
}

void cholesky_forward(const double *L, int n, double *b) {
  const Eigen::Map<const rows_t> l(L, n, n);
  Eigen::Map<Eigen::VectorXd> x(b, n);
  l.triangularView<Eigen::Lower>().solveInPlace(x);
}

void cholesky_backward(const double *L, int n, double *b) {
  const Eigen::Map<const rows_t> l(L, n, n);
  Eigen::Map<Eigen::VectorXd> x(b, n);
  l.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
}
