// dense.cpp - dense matrices by Eigen.
#include "base/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SVD>

// One factorisation serves all matrices that are not symmetric: they are small, and each kind of
// factorisation takes seconds to compile.
using svd_t = Eigen::JacobiSVD<MatrixXd, Eigen::FullPivHouseholderQRPreconditioner>;

static svd_t factors(const MatrixXd &A) {
  return svd_t(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
}

MatrixXd dense_product(const MatrixXd &A, const MatrixXd &B) {
  return A * B;
}

VectorXd dense_apply(const MatrixXd &A, const VectorXd &b) {
  return A * b;
}

MatrixXd dense_scaled(const MatrixXd &A, const VectorXd &scale) {
  return scale.asDiagonal() * A * scale.asDiagonal();
}

VectorXd dense_least_squares(const MatrixXd &A, const VectorXd &b) {
  return factors(A).solve(b);
}

VectorXd dense_solve_symmetric(const MatrixXd &A, const VectorXd &b, MatrixXd *inverse) {
  const Eigen::LDLT<MatrixXd> ldlt(A);
  if (inverse) *inverse = ldlt.solve(MatrixXd(MatrixXd::Identity(A.rows(), A.cols())));
  return ldlt.solve(b);
}

bool dense_invert(const MatrixXd &A, MatrixXd &inverse) {
  const svd_t svd = factors(A);
  if (svd.rank() < A.rows()) return false;
  inverse = svd.solve(MatrixXd(MatrixXd::Identity(A.rows(), A.cols())));
  return true;
}
