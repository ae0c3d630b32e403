// lsq_blocks.cpp - least squares from sums of products.
#include "gap/lsq_blocks.h"

#include <Eigen/Dense>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

using matrix_t = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using view_t = Eigen::Map<const matrix_t>;

void lsq_add_products(int rows, int n, const double *const *X, const int *column, int size, double *G,
                      double *also) {
  Eigen::MatrixXd x(rows, n);
  for (int j = 0; j < n; j++) x.col(j) = Eigen::Map<const Eigen::VectorXd>(X[j], rows);
  Eigen::MatrixXd products(n, n);
  products.triangularView<Eigen::Upper>() = x.transpose() * x;
  products.triangularView<Eigen::StrictlyLower>() = products.transpose();
  for (double *to : {G, also})
    for (int i = 0; to && i < n; i++)
      for (int j = 0; j < n; j++) to[column[i] * size + column[j]] += products(j, i);
}

static void take(const double *G, int size, const int *column, int n, Eigen::MatrixXd &A,
                 Eigen::VectorXd &c) {
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
  Eigen::MatrixXd A;
  Eigen::VectorXd c;
  take(G, size, column, n, A, c);
  const Eigen::MatrixXd plain = A;
  for (int i = 0; i < n; i++) A(i, i) += (ridge ? ridge[column[i]] : 0.0) + 1e-12 * A(i, i) + 1e-300;
  // Scaled to a unit diagonal: regressors differ by many powers of ten.
  const Eigen::VectorXd scale = A.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> factors((scale.asDiagonal() * A * scale.asDiagonal()).eval());
  const Eigen::VectorXd x = scale.asDiagonal() * factors.solve((scale.asDiagonal() * c).eval());
  Eigen::Map<Eigen::VectorXd>(b, n) = x;
  if (inverse) {
    const Eigen::MatrixXd unit = factors.solve(Eigen::MatrixXd::Identity(n, n));
    Eigen::Map<matrix_t>(inverse, n, n) = scale.asDiagonal() * unit * scale.asDiagonal();
  }
  return all - 2.0 * x.dot(c) + x.dot(plain * x);
}

double lsq_left(const double *G, int size, const int *column, int n, const double *b) {
  const double all = G[size * size - 1];
  if (n == 0) return all;
  Eigen::MatrixXd A;
  Eigen::VectorXd c;
  take(G, size, column, n, A, c);
  const Eigen::Map<const Eigen::VectorXd> x(b, n);
  return all - 2.0 * x.dot(c) + x.dot(A * x);
}

double lsq_wald(const double *b, const double *V, int n) {
  const Eigen::Map<const Eigen::VectorXd> x(b, n);
  const view_t spread(V, n, n);
  if (!(spread.diagonal().minCoeff() > 0.0)) return HUGE_VAL;
  const Eigen::VectorXd scale = spread.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd y = scale.asDiagonal() * x;
  return y.dot((scale.asDiagonal() * spread * scale.asDiagonal()).ldlt().solve(y));
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
