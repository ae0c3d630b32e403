// oracle.cpp - eigenvalues by Jacobi's rotations, random numbers by the C++ library.
#include "rig/oracle.h"

#include <algorithm>
#include <cmath>
#include <random>

// Turns the axes p and q so that the element between them is nothing.
static void rotate(double (*A)[ORACLE_N], int p, int q) {
  if (A[q][p] == 0.0) return;
  const double half = (A[q][q] - A[p][p]) / (2.0 * A[q][p]);
  const double t = std::copysign(1.0, half) / (std::fabs(half) + std::hypot(half, 1.0));
  const double c = 1.0 / std::hypot(t, 1.0), s = t * c;
  for (int k = 0; k < ORACLE_N; k++) {
    const double a = A[k][p], b = A[k][q];
    A[k][p] = c * a - s * b;
    A[k][q] = s * a + c * b;
  }
  for (int k = 0; k < ORACLE_N; k++) {
    const double a = A[p][k], b = A[q][k];
    A[p][k] = c * a - s * b;
    A[q][k] = s * a + c * b;
  }
}

void oracle_eigenvalues(const double A[ORACLE_N][ORACLE_N], double values[ORACLE_N]) {
  double D[ORACLE_N][ORACLE_N], all = 0.0, off = 1.0;
  for (int i = 0; i < ORACLE_N; i++)
    for (int j = 0; j < ORACLE_N; j++) {
      D[i][j] = A[std::max(i, j)][std::min(i, j)];
      all += D[i][j] * D[i][j];
    }
  // Quadratic at the end: from 1e-15 of the size on nothing changes any more. 30 sweeps: NaN ends too.
  for (int sweep = 0; sweep < 30 && off > 1e-30 * all; sweep++) {
    off = 0.0;
    for (int q = 1; q < ORACLE_N; q++)
      for (int p = 0; p < q; p++) {
        off += D[q][p] * D[q][p];
        rotate(D, p, q);
      }
  }
  for (int i = 0; i < ORACLE_N; i++) values[i] = D[i][i];
  std::sort(values, values + ORACLE_N);
}

void oracle_uniform(uint64_t seed, int n, double *out) {
  std::mt19937_64 bits(seed);
  for (int i = 0; i < n; i++) out[i] = std::uniform_real_distribution<double>(0.0, 1.0)(bits);
}

void oracle_normal(uint64_t seed, int n, double *out) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> normal;
  for (int i = 0; i < n; i++) out[i] = normal(bits);
}
