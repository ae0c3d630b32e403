// lsq_products.c - sums of products of columns.
#include "base/lsq_blocks.h"
#include "base/wide.h"
#include <stdlib.h>

// Rows that are taken at once, and of a tile columns down; across it has WIDE. What a tile adds up stays in
// registers, for which four sums are enough to wait for none of them.
enum { ROWS = 64, DOWN = 4 };

// One tile of a sum: rows of `x`, `pad` numbers each, of which `down` and `across` are the first that meet.
WIDE_INLINE void add_tile(const double *x, int rows, int pad, int down, int across, double *sum) {
  wide_t all[DOWN];
  for (int i = 0; i < DOWN; i++) WIDE_LOAD(all[i], sum + (down + i) * pad + across);
  for (int r = 0; r < rows; r++) {
    const double *const row = x + r * pad;
    wide_t there;
    WIDE_LOAD(there, row + across);
    for (int i = 0; i < DOWN; i++) all[i] += row[down + i] * there;
  }
  for (int i = 0; i < DOWN; i++) WIDE_PUT(sum + (down + i) * pad + across, all[i]);
}

// Of a symmetric sum, the tiles that hold one half.
WIDE_COPIES static void add_rows(const double *x, int rows, int pad, double *sum) {
  for (int across = 0; across < pad; across += WIDE)
    for (int down = 0; down < across + WIDE; down += DOWN) add_tile(x, rows, pad, down, across, sum);
}

// Columns become rows; behind the last there are noughts.
static void turn(const double *const *column, int from, int rows, int n, int pad, double *x) {
  for (int j = 0; j < pad; j++)
    for (int r = 0; r < rows; r++) x[r * pad + j] = j < n ? column[j][from + r] : 0.0;
}

bool lsq_sum_products(int rows, int n, const double *const *X, const int *column, int size, double *G) {
  const int pad = (n + WIDE - 1) / WIDE * WIDE;
  double *const sum = malloc((size_t)(pad * (pad + ROWS) + 1) * sizeof(double));
  if (!sum) return false;
  memset(sum, 0, (size_t)(pad * pad) * sizeof(double));
  double *const x = sum + pad * pad;
  for (int from = 0; from < rows; from += ROWS) {
    const int here = rows - from < ROWS ? rows - from : ROWS;
    turn(X, from, here, n, pad, x);
    add_rows(x, here, pad, sum);
  }
  for (int i = 0; i < n; i++)
    for (int j = i; j < n; j++) {
      const double product = sum[i * pad + j];
      G[column[i] * size + column[j]] += product;
      if (i != j) G[column[j] * size + column[i]] += product;
    }
  free(sum);
  return true;
}
