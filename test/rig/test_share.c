// test_share.c - the bound behind promises about shares.
#include "rig/share.h"

TEST(share_fewest_is_the_binomial_s_lower_end) {
  static const struct {
    int n;
    double promise;
    int fewest;
  } row[] = {
      {10, 1.0, 10},   // 1 means all
      {20, 0.998, 19}, // two of twenty fail: 7.4e-4
      {3, 0.9, 1},     // none of three keeps it: exactly 1e-3, but for rounding
      {10, 0.5, 1},    // none of ten: 9.8e-4
      {9, 0.5, 0},     // none of nine: 2e-3
      {1000, 0.5, 451},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d, %g", row[i].n, row[i].promise);
    CHECK_NEAR(share_fewest(row[i].n, row[i].promise), row[i].fewest, 0.0);
  }
}
