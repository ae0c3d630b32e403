// test_gap_blocks.c - least squares by blocks, and white rows: values by hand and coefficients that are
// known.
#include "base/lsq_blocks.h"
#include "base/nth.h"
#include "base/random.h"
#include "gap/5_infer/whiten.h"
#include "rig/test.h"

#include <stdlib.h>
#include <string.h>

// y = 1, 2, 4, 7 over x = 0, 1, 2, 3 and a constant: slope 2, offset 0.5, and 0.5, -0.5, -0.5, 0.5 is left.
TEST(gap_blocks_fit_a_line_as_by_hand) {
  static const double one[] = {1.0, 1.0, 1.0, 1.0}, x[] = {0.0, 1.0, 2.0, 3.0}, y[] = {1.0, 2.0, 4.0, 7.0};
  static const int all[] = {0, 1, 2};
  double G[9] = {0.0}, also[9] = {0.0}, b[2], inverse[4];
  // As two blocks: sums of products add up.
  for (int from = 0; from < 4; from += 2)
    lsq_add_products(2, 3, (const double *const[]){one + from, x + from, y + from}, all, 3, G,
                     from ? also : NULL);
  lsq_mirror(G, 3);
  lsq_mirror(also, 3);
  CHECK_NEAR(G[8], 70.0, 1e-12);
  CHECK_NEAR(also[5], 29.0, 1e-12); // 2 * 4 + 3 * 7, of the second block
  CHECK_NEAR(also[7], 29.0, 1e-12);
  CHECK_NEAR(lsq_solve_products(G, 3, all, 2, NULL, b, inverse), 1.0, 1e-9);
  CHECK_NEAR(b[0], 0.5, 1e-9);
  CHECK_NEAR(b[1], 2.0, 1e-9);
  CHECK_NEAR(inverse[0], 0.7, 1e-9); // of {{4, 6}, {6, 14}}
  CHECK_NEAR(inverse[1], -0.3, 1e-9);
  CHECK_NEAR(inverse[3], 0.2, 1e-9);
  CHECK_NEAR(lsq_left(G, 3, all, 2, (const double[]){0.5, 1.0}), 15.0,
             1e-9); // squares of 0.5, 0.5, 1.5, 3.5
}

TEST(gap_blocks_hold_a_ridge_back_and_leave_its_share_out) {
  // One regressor, products 4 and 6 of 10: b = 6 / (4 + 2) = 1, and 10 - 12 + 4 = 2 is left.
  static const double G[] = {4.0, 6.0, 6.0, 10.0}, ridge[] = {2.0};
  double b;
  CHECK_NEAR(lsq_solve_products(G, 2, (const int[]){0}, 1, ridge, &b, NULL), 2.0, 1e-9);
  CHECK_NEAR(b, 1.0, 1e-9);
}

// b = (2, 1), V = {{2, 1}, {1, 1}}: V^-1 = {{1, -1}, {-1, 2}}, b' V^-1 b = 4 - 4 + 2 = 2; F = 2 / 2 = 1.
// F(2, 2) lies above f with probability 1 / (1 + f), F(2, n) with (1 + 2 f / n)^(-n/2).
TEST(gap_blocks_wald_test_is_that_of_a_case_by_hand) {
  static const double b[] = {2.0, 1.0}, V[] = {2.0, 1.0, 1.0, 1.0}, singular[] = {0.0, 0.0, 0.0, 1.0};
  const double wald = lsq_wald(b, V, 2);
  CHECK_NEAR(wald, 2.0, 1e-12);
  CHECK_NEAR(lsq_f_above(wald / 2.0, 2.0, 2.0), 0.5, 1e-12);
  CHECK_NEAR(lsq_f_above(3.0, 2.0, 4.0), 0.16, 1e-12);
  CHECK_NEAR(lsq_f_above(50.0, 2.0, 10.0), pow(11.0, -5.0), 1e-15);
  CHECK_NEAR(lsq_f_above(0.0, 2.0, 10.0), 1.0, 0.0);
  CHECK(isinf(lsq_wald(b, singular, 2)) && lsq_f_above(HUGE_VAL, 2.0, 10.0) == 0.0);
  // Student's t of one degree of freedom is Cauchy's: a quarter lies above 1.
  CHECK_NEAR(lsq_t_quantile(0.25, 1.0), 1.0, 1e-9);
}

#define ROWS 20000

// Rows of an autoregression with a1, a2 and this spread; every 500th begins anew.
static rows_t colored(double a1, double a2, double sd, double *v) {
  static bool follows[ROWS];
  random_t *const random = random_open(5);
  if (!random) abort();
  for (int i = 0; i < ROWS; i++) {
    follows[i] = i % 500 != 0;
    const double before = follows[i] ? a1 * v[i - 1] : 0.0;
    const double before_that = follows[i] && follows[i - 1] ? a2 * v[i - 2] : 0.0;
    v[i] = before + before_that + sd * random_normal(random);
    if (!follows[i]) v[i] += 30.0 * sd; // what is before a gap says nothing of what is after it
  }
  random_close(random);
  return (rows_t){.n = ROWS, .follows = follows};
}

TEST(gap_whitening_recovers_the_coefficients_of_known_noise) {
  static const double cases[][3] = {{1.2, -0.5, 0.3}, {0.6, 0.2, 2.0}, {0.0, 0.0, 1.0}, {-0.4, -0.3, 1e-3}};
  double *const v = malloc(2 * ROWS * sizeof(double)), *const white = v + ROWS;
  if (!v) abort();
  for (unsigned k = 0; k < sizeof cases / sizeof *cases; k++) {
    ROW("a1 %g, a2 %g", cases[k][0], cases[k][1]);
    const rows_t rows = colored(cases[k][0], cases[k][1], cases[k][2], v);
    const color_t color = color_fit(&rows, v);
    CHECK(color.used);
    CHECK_NEAR(color.a1, cases[k][0], 0.03);
    CHECK_NEAR(color.a2, cases[k][1], 0.03);
    CHECK_NEAR(color.sd, cases[k][2], 0.03 * cases[k][2]);
    color_whiten(&color, &rows, v, white);
    double squares = 0.0, next = 0.0;
    int n = 0;
    for (int i = 0; i < ROWS; i++) {
      if (!color_reaches(&rows, i)) {
        CHECK_NEAR(white[i], 0.0, 0.0);
        continue;
      }
      n++;
      squares += white[i] * white[i];
      next += white[i] * white[i - 1];
    }
    CHECK_NEAR(squares / n, 1.0, 1e-9);
    CHECK_NEAR(next / n, 0.0, 0.03);
  }
  free(v);
}

TEST(gap_whitening_wants_rows_enough) {
  static const double v[ROWS] = {1.0, -1.0, 0.5, 0.3, -0.2};
  static bool follows[ROWS] = {false, true, true, true, true};
  const rows_t few = {.n = 5, .follows = follows};
  CHECK(!color_fit(&few, v).used);
}

TEST(gap_nth_smallest_is_that_of_the_sorted_list) {
  static const double v[] = {3.0, -1.0, 7.0, 3.0, 0.5, 9.0}, sorted[] = {-1.0, 0.5, 3.0, 3.0, 7.0, 9.0};
  for (int k = 0; k < 6; k++) {
    double room[6];
    ROW("%d", k);
    memcpy(room, v, sizeof v);
    CHECK_NEAR(nth_smallest(room, 6, k), sorted[k], 0.0);
    for (int i = 0; i < 6; i++) CHECK(i < k ? room[i] <= sorted[k] : room[i] >= sorted[k]);
  }
}
