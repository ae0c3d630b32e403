// test_lsq.c - least squares, and the eigenvalues that the tests ask for.
#include "base/lsq.h"
#include "rig/oracle.h"
#include "rig/test.h"

TEST(least_squares_gives_the_smallest_residual_and_of_several_the_shortest) {
  static const struct {
    const char *what;
    int rows, columns;
    double A[8], b[4], want[3];
  } row[] = {
      {"a line through four points", 4, 2, {1, 0, 1, 1, 1, 2, 1, 3}, {1, 3, 5, 7}, {1, 2}},
      {"a line beside four points", 4, 2, {1, 0, 1, 1, 1, 2, 1, 3}, {0, 1, 1, 2}, {0.1, 0.6}},
      {"one equation for three", 1, 3, {1, 2, 2}, {9}, {1, 2, 2}},
      {"the same column twice", 3, 2, {1, 1, 2, 2, 3, 3}, {2, 4, 6}, {1, 1}},
      {"nothing at all", 2, 2, {0, 0, 0, 0}, {1, 2}, {0, 0}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    double x[3];
    lsq_solve(row[i].rows, row[i].columns, row[i].A, row[i].b, x);
    for (int k = 0; k < row[i].columns; k++) CHECK_NEAR(x[k], row[i].want[k], 1e-13);
  }
}

// Of tridiag(-1, 2, -1): 2 - 2 cos(k pi / 8).
TEST(oracle_gives_the_eigenvalues_of_a_chain_of_springs) {
  double A[ORACLE_N][ORACLE_N] = {{0}}, value[ORACLE_N];
  for (int i = 0; i < ORACLE_N; i++) {
    A[i][i] = 2.0;
    if (i > 0) A[i][i - 1] = -1.0;
    if (i > 0) A[i - 1][i] = (double)NAN; // is not read
  }
  oracle_eigenvalues((const double(*)[ORACLE_N])A, value);
  for (int k = 0; k < ORACLE_N; k++) CHECK_NEAR(value[k], 2.0 - 2.0 * cos((k + 1) * acos(-1.0) / 8.0), 1e-14);
}
