// lsq_blocks.cpp - least squares from sums of products.
#include "base/lsq_blocks.h"

#include "base/dense.hpp"
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

using matrix_t = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using view_t = Eigen::Map<const matrix_t>;

static void take(const double *G, int size, const int *column, int n, MatrixXd &A, VectorXd &c) {
  const view_t all(G, size, size);
  A.resize(n, n);
  c.resize(n);
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < n; j++) A(i, j) = all(column[i], column[j]);
    c(i) = all(column[i], size - 1);
  }
}

double lsq_solve_products(const double *G, int size, const int *column, int n, const double *ridge, double *b,
                          double *inverse) {
  const double all = G[size * size - 1];
  if (n == 0) return all;
  MatrixXd A;
  VectorXd c;
  take(G, size, column, n, A, c);
  const MatrixXd plain = A;
  for (int i = 0; i < n; i++) A(i, i) += (ridge ? ridge[column[i]] : 0.0) + 1e-12 * A(i, i) + 1e-300;
  // Scaled to a unit diagonal, because regressors differ by many powers of ten.
  const VectorXd scale = A.diagonal().cwiseSqrt().cwiseInverse();
  MatrixXd unit;
  const VectorXd scaled =
      dense_solve_symmetric(dense_scaled(A, scale), scale.cwiseProduct(c), inverse ? &unit : nullptr);
  const VectorXd x = scale.cwiseProduct(scaled);
  Eigen::Map<VectorXd>(b, n) = x;
  if (inverse) Eigen::Map<matrix_t>(inverse, n, n) = dense_scaled(unit, scale);
  return all - 2.0 * x.dot(c) + x.dot(dense_apply(plain, x));
}

double lsq_left(const double *G, int size, const int *column, int n, const double *b) {
  const double all = G[size * size - 1];
  if (n == 0) return all;
  MatrixXd A;
  VectorXd c;
  take(G, size, column, n, A, c);
  const VectorXd x = Eigen::Map<const VectorXd>(b, n);
  return all - 2.0 * x.dot(c) + x.dot(dense_apply(A, x));
}

double lsq_wald(const double *b, const double *V, int n) {
  const Eigen::Map<const VectorXd> x(b, n);
  const view_t spread(V, n, n);
  if (!(spread.diagonal().minCoeff() > 0.0)) return HUGE_VAL;
  const VectorXd scale = spread.diagonal().cwiseSqrt().cwiseInverse();
  const VectorXd y = scale.cwiseProduct(x);
  return y.dot(dense_solve_symmetric(dense_scaled(spread, scale), y));
}

double lsq_f_above(double f, double n1, double n2) {
  if (!(f > 0.0)) return 1.0;
  if (!std::isfinite(f)) return 0.0;
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(n1, n2), f));
}

double lsq_f_quantile(double p, double n1, double n2) {
  return boost::math::quantile(boost::math::complement(boost::math::fisher_f(n1, n2), p));
}

double lsq_t_quantile(double p, double n) {
  return boost::math::quantile(boost::math::complement(boost::math::students_t(n), p));
}
