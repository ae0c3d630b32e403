// oracle.cpp - linear algebra in double by Eigen, random numbers by the C++ library.
#include "oracle.h"

#include <Eigen/Dense>
#include <random>

using Row = Eigen::Matrix<double, ORACLE_N, 1>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, ORACLE_N, Eigen::RowMajor>;
using Square = Eigen::Matrix<double, ORACLE_N, ORACLE_N, Eigen::RowMajor>;

void oracle_least_squares(int n, const double (*A)[ORACLE_N], const double *y, double x[ORACLE_N]) {
  const Rows rows = Eigen::Map<const Rows>(&A[0][0], n, ORACLE_N);
  const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(y, n);
  Eigen::Map<Row>(x, ORACLE_N) = rows.colPivHouseholderQr().solve(right);
}

void oracle_eigenvalues(const double A[ORACLE_N][ORACLE_N], double values[ORACLE_N]) {
  const Square square = Eigen::Map<const Square>(&A[0][0]);
  Eigen::Map<Row>(values, ORACLE_N) =
      Eigen::SelfAdjointEigenSolver<Square>(square, Eigen::EigenvaluesOnly).eigenvalues();
}

void oracle_uniform(uint64_t seed, int n, double *out) {
  std::mt19937_64 bits(seed);
  for (int i = 0; i < n; i++) out[i] = std::uniform_real_distribution<double>(0.0, 1.0)(bits);
}
