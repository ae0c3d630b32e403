// test_gap_threads.c - a diagnosis gives the same bits, however many threads work on it.
#include "rig/gap_case.h"
#include "rig/test.h"

#include <string.h>
#ifdef _OPENMP
#include <omp.h>
#endif

// Built without OpenMP there is but one, and both of what is compared are the same run twice.
static int use_threads(int n) {
  int before = 1;
#ifdef _OPENMP
  before = omp_get_max_threads();
  omp_set_num_threads(n);
#else
  (void)n;
#endif
  return before;
}

static bool same_bits(const double *a, const double *b, size_t n) {
  return memcmp(a, b, n * sizeof *a) == 0;
}

static void compare_nominal(const nominal_t *a, const nominal_t *b) {
  if (!CHECK(a->n == b->n) || !CHECK(a->size == b->size)) return;
  CHECK(same_bits(a->total, b->total, (size_t)(a->n * a->size * a->size)));
  CHECK(same_bits(a->kept, b->kept, (size_t)a->size));
  CHECK(same_bits(a->floor, b->floor, CHANNELS));
  CHECK(same_bits(a->misfit, b->misfit, CHANNELS));
  for (int i = 0; i < a->n; i++)
    for (int k = 0; k < UNKNOWN_CELLS; k++) {
      const cell_t *const one = &a->scan[i].cell[k], *const other = &b->scan[i].cell[k];
      ROW("flight %d, cell %d", i, k);
      CHECK(same_bits(&one->statistic, &other->statistic, 1) && same_bits(&one->size, &other->size, 1));
    }
}

static void compare_names(const found_t *a, const found_t *b) {
  if (!CHECK(a->n == b->n)) return;
  for (int i = 0; i < a->n; i++) {
    const named_t *const one = &a->named[i], *const other = &b->named[i];
    ROW("name %d", i);
    CHECK(one->candidate == other->candidate);
    CHECK(same_bits(one->value, other->value, FX_SIZE_MAX));
    CHECK(same_bits(one->stderr_, other->stderr_, FX_SIZE_MAX));
    CHECK(same_bits(&one->probability, &other->probability, 1));
  }
}

TEST(gap_says_the_same_to_the_bit_whatever_the_number_of_threads) {
  const gap_hidden_t hidden = {2,
                               {gap_effect("thrust_scale", 0.92, 0.0), gap_effect("motor_lag", 0.03, 0.0)}};
  const int before = use_threads(1);
  gap_case_t *const alone = gap_case(&hidden, &hidden);
  use_threads(3);
  gap_case_t *const together = gap_case(&hidden, &hidden);
  use_threads(before);
  const diagnosis_t *const a = &alone->d, *const b = &together->d;
  CHECK(a->nominal.n > 1 && a->found.n > 0); // there is something to compare
  CHECK(a->rounds == b->rounds);
  compare_nominal(&a->nominal, &b->nominal);
  compare_names(&a->found, &b->found);
  for (int ch = 0; ch < CHANNELS; ch++)
    CHECK(same_bits(a->residual[ch], b->residual[ch], (size_t)set_rows(&a->fit, ch)->n));
  CHECK(same_bits(&a->left.cell.statistic, &b->left.cell.statistic, 1));
  gap_case_free(alone);
  gap_case_free(together);
}
