// test_lsq_products.c - sums of products, four rows at a time: each goes over its rows in their order.
#include "base/lsq_blocks.h"
#include "base/random.h"
#include "rig/test.h"

#include <stdlib.h>

enum { ROWS_MOST = 1500, COLUMNS_MOST = 21 };

// Panels of 504 rows at most, about as long as each other: as they fitted 32 kB beside a tile.
TEST(lsq_products_go_over_rows_in_their_order_panel_by_panel) {
  static const struct {
    int rows, columns, panel;
  } row[] = {{1, 1, 504},   {50, 3, 504},   {64, 8, 504},   {65, 9, 504},    {504, 17, 504},
             {600, 5, 304}, {750, 12, 376}, {1000, 2, 504}, {1008, 21, 504}, {1500, 4, 504}};
  double *const room = malloc(COLUMNS_MOST * ROWS_MOST * sizeof *room);
  random_t *const random = random_open(3);
  if (!room || !random) abort();
  random_normals(random, COLUMNS_MOST * ROWS_MOST, room);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    const int n = row[i].columns, size = n + 2;
    ROW("%d rows, %d columns", row[i].rows, n);
    const double *X[COLUMNS_MOST];
    int column[COLUMNS_MOST];
    double G[(COLUMNS_MOST + 2) * (COLUMNS_MOST + 2)] = {0.0}, also[sizeof G / sizeof *G] = {0.0};
    for (int j = 0; j < n; j++) X[j] = room + j * ROWS_MOST, column[j] = j + 1 + (j > 4);
    CHECK(lsq_add_products(row[i].rows, n, X, column, size, G, also));
    lsq_mirror(G, size);
    lsq_mirror(also, size);
    for (int j = 0; j < n; j++)
      for (int k = 0; k < n; k++) {
        double sum = 0.0;
        for (int from = 0; from < row[i].rows; from += row[i].panel) {
          double part = 0.0;
          for (int r = from; r < row[i].rows && r < from + row[i].panel; r++) part += X[j][r] * X[k][r];
          sum += part;
        }
        CHECK(G[column[j] * size + column[k]] == sum && also[column[j] * size + column[k]] == sum);
      }
    CHECK(G[0] == 0.0); // of no column
  }
  random_close(random);
  free(room);
}
