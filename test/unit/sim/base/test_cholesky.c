// test_cholesky.c - factors and solutions of small matrices against numbers worked out by hand.
#include "base/cholesky.h"
#include "rig/test.h"

#include <math.h>

// L = [2 0 0; 1 3 0; -1 2 1], A = L L'.
static const double A[] = {4, 2, -2, 2, 10, 5, -2, 5, 6};

TEST(cholesky_finds_the_factor_below_the_diagonal) {
  double L[9];
  for (int i = 0; i < 9; i++) L[i] = A[i];
  CHECK(cholesky(L, 3));
  const double want[] = {2, 0, 0, 1, 3, 0, -1, 2, 1};
  for (int i = 0; i < 3; i++)
    for (int k = 0; k <= i; k++) CHECK_NEAR(L[3 * i + k], want[3 * i + k], 1e-14);
}

// A [1 2 -1]' = [10 17 2]', by both halves of the way.
TEST(cholesky_solves_forward_and_backward) {
  double L[9], b[] = {10, 17, 2};
  for (int i = 0; i < 9; i++) L[i] = A[i];
  CHECK(cholesky(L, 3));
  cholesky_forward(L, 3, b);
  CHECK_NEAR(b[0], 5.0, 1e-14); // L^-1 b
  CHECK_NEAR(b[1], 4.0, 1e-14);
  CHECK_NEAR(b[2], -1.0, 1e-13);
  cholesky_backward(L, 3, b);
  CHECK_NEAR(b[0], 1.0, 1e-13);
  CHECK_NEAR(b[1], 2.0, 1e-13);
  CHECK_NEAR(b[2], -1.0, 1e-13);
}

TEST(cholesky_says_that_a_matrix_is_not_positive) {
  const double nan = (double)NAN;
  double rows[][4] = {{1, 1, 1, 1}, {1, 2, 2, 1}, {nan, 0, 0, 1}, {1, nan, nan, 1}, {1, 0, 0, nan}};
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    ROW("%u", i);
    CHECK(!cholesky(rows[i], 2));
  }
}
