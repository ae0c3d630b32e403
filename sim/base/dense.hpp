// dense.hpp - what the C++ files do with dense matrices, by Eigen, compiled once: each file that factorises
// or multiplies by itself takes 5 to 15 s of a processor and up to 700 MB for it.
#ifndef SIM_DENSE_HPP
#define SIM_DENSE_HPP

#include <Eigen/Core>

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A B and A b.
MatrixXd dense_product(const MatrixXd &A, const MatrixXd &B);
VectorXd dense_apply(const MatrixXd &A, const VectorXd &b);

// diag(scale) A diag(scale)
MatrixXd dense_scaled(const MatrixXd &A, const VectorXd &scale);

// The x that makes |A x - b| smallest; of several, the shortest.
VectorXd dense_least_squares(const MatrixXd &A, const VectorXd &b);

// The solution of A x = b; A is symmetric and positive. Only its lower triangle is read. inverse: of A, or
// null.
VectorXd dense_solve_symmetric(const MatrixXd &A, const VectorXd &b, MatrixXd *inverse = nullptr);

// The inverse of A. False: it has none, and `inverse` is as before.
bool dense_invert(const MatrixXd &A, MatrixXd &inverse);

#endif
