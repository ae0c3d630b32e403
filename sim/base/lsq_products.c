// lsq_products.c - sums of products of columns.
#include "base/lsq_blocks.h"
#include "base/wide.h"
#include <stdlib.h>

// ROWS: rows taken at once. DOWN: columns of a tile downwards; across it has WIDE. A tile's sums stay in
// registers, and eight vector sums are enough to wait for none of them.
enum { ROWS = 64, DOWN = 4 };

// Adds rows of `x`, `pad` numbers each, to one tile of a sum: the products of DOWN columns from `down` and
// WIDE columns from `across`.
WIDE_INLINE void add_tile(const double *x, int rows, int pad, int down, int across, double *sum) {
  four_t low[DOWN], high[DOWN];
  for (int i = 0; i < DOWN; i++) {
    FOUR_LOAD(low[i], sum + (down + i) * pad + across);
    FOUR_LOAD(high[i], sum + (down + i) * pad + across + HALF);
  }
  for (int r = 0; r < rows; r++) {
    const double *const row = x + r * pad;
    four_t there_low, there_high;
    FOUR_LOAD(there_low, row + across);
    FOUR_LOAD(there_high, row + across + HALF);
    for (int i = 0; i < DOWN; i++) {
      low[i] += row[down + i] * there_low;
      high[i] += row[down + i] * there_high;
    }
  }
  for (int i = 0; i < DOWN; i++) {
    FOUR_PUT(sum + (down + i) * pad + across, low[i]);
    FOUR_PUT(sum + (down + i) * pad + across + HALF, high[i]);
  }
}

// Adds to the tiles that hold one half of a symmetric sum.
WIDE_COPIES static void add_rows(const double *x, int rows, int pad, double *sum) {
  for (int across = 0; across < pad; across += WIDE)
    for (int down = 0; down < across + WIDE; down += DOWN) add_tile(x, rows, pad, down, across, sum);
}

// Turns columns into rows, padded with zeros.
static void turn(const double *const *column, int from, int rows, int n, int pad, double *x) {
  for (int j = 0; j < pad; j++)
    for (int r = 0; r < rows; r++) x[r * pad + j] = j < n ? column[j][from + r] : 0.0;
}

// The number of rows that are summed separately before they are added to the others, in parts of about equal
// length: one long sum would lose digits. 504 is what fits 32 kB beside a tile of Eigen, which did this
// before, so that the digits of all verdicts stay the same (test_lsq_products.c).
static int panel_of(int rows) {
  enum { MOST = 504, STEP = 8 };
  const int over = rows % MOST;
  if (rows <= MOST || over == 0) return rows < MOST ? rows : MOST;
  return MOST - STEP * ((MOST - 1 - over) / (STEP * (rows / MOST + 1)));
}

static int least(int a, int b) {
  return a < b ? a : b;
}

// Columns that are neighbours both in `sum` and in G are added together.
static void put_sums(const double *sum, int n, int pad, const int *column, int size, double *G) {
  for (int i = 0; i < n; i++)
    for (int j = i; j < n;) {
      const double *const from = sum + i * pad + j;
      double *const to = G + column[i] * size + column[j];
      int many = 1;
      while (j + many < n && column[j + many] == column[j] + many) many++;
      for (int k = 0; k < many; k++) to[k] += from[k];
      j += many;
    }
}

static void add_panel(const double *const *X, int from, int end, int n, int pad, double *x, double *sum) {
  memset(sum, 0, (size_t)(pad * pad) * sizeof(double));
  for (; from < end; from += ROWS) {
    const int rows = least(end - from, ROWS);
    turn(X, from, rows, n, pad, x);
    add_rows(x, rows, pad, sum);
  }
}

bool lsq_add_products(int rows, int n, const double *const *X, const int *column, int size, double *G,
                      double *also) {
  const int pad = (n + WIDE - 1) / WIDE * WIDE, panel = panel_of(rows);
  const size_t square = (size_t)(pad * pad);
  double *const sum = malloc((2 * square + (size_t)(pad * ROWS) + 1) * sizeof(double));
  if (!sum) return false;
  double *const part = sum + square, *const x = part + square;
  add_panel(X, 0, least(panel, rows), n, pad, x, sum);
  for (int from = panel; from < rows; from += panel) {
    add_panel(X, from, least(from + panel, rows), n, pad, x, part);
    for (size_t i = 0; i < square; i++) sum[i] += part[i];
  }
  put_sums(sum, n, pad, column, size, G);
  if (also) put_sums(sum, n, pad, column, size, also);
  free(sum);
  return true;
}

void lsq_mirror(double *G, int size) {
  for (int i = 0; i < size; i++)
    for (int j = i + 1; j < size; j++) G[j * size + i] = G[i * size + j];
}
