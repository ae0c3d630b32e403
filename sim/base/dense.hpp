// dense.hpp - operations on dense matrices for the C++ files, by Eigen, compiled once: a file that itself
// factorises or multiplies takes 5 to 15 s and up to 700 MB to compile.
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

// The x that minimises |A x - b|; where several do, the shortest.
VectorXd dense_least_squares(const MatrixXd &A, const VectorXd &b);

// Solves A x = b for a symmetric positive definite A, of which only the lower triangle is read. inverse:
// receives that of A; may be null.
VectorXd dense_solve_symmetric(const MatrixXd &A, const VectorXd &b, MatrixXd *inverse = nullptr);

// Sets `inverse` to that of A. False if A is singular; `inverse` then keeps its value.
bool dense_invert(const MatrixXd &A, MatrixXd &inverse);

#endif
