// test_lpf2_range.c - the low-pass tuned to every float.
#include "flight/lpf2.h"
#include "rig/every_float.h"

static const lpf2_coef_t OFF = {.b0 = 1.0f}, BEFORE = {1.0f, 2.0f, 3.0f, 4.0f, 5.0f};

static bool same(const lpf2_coef_t *a, const lpf2_coef_t *b) {
  return a->b0 == b->b0 && a->b1 == b->b1 && a->b2 == b->b2 && a->a1 == b->a1 && a->a2 == b->a2;
}

// Off the formula in double, all five together; infinite where the filter is not stable.
static double error_of(const lpf2_coef_t *c, double cutoff_Hz, double rate_Hz) {
  if (!(fabsf(c->a2) < 1.0f && fabs((double)c->a1) < 1.0 + (double)c->a2)) return HUGE_VAL;
  const double k = tan(3.14159265358979323846 * cutoff_Hz / rate_Hz);
  const double n = 1.0 + sqrt(2.0) * k + k * k, b0 = k * k / n;
  const double off[] = {(double)c->b0 / b0 - 1.0, (double)c->b1 / b0 - 2.0, (double)c->b2 / b0 - 1.0,
                        (double)c->a1 - 2.0 * (k * k - 1.0) / n,
                        (double)c->a2 - (1.0 - sqrt(2.0) * k + k * k) / n};
  double sum = 0.0;
  for (int i = 0; i < 5; i++) sum += fabs(off[i]);
  return sum;
}

TEST(filter_of_every_cut_off_is_stable_and_as_the_formula_or_refused) {
  static const float rate_Hz[] = {100.0f, 500.0f}; // the loops'
  for (unsigned i = 0; i < sizeof rate_Hz / sizeof *rate_Hz; i++) {
    const float rate = rate_Hz[i];
    worst_t worst = {0.0, 0.0f};
    uint64_t ends_wrong = 0;
    float cutoff_Hz;
    for (EVERY_FLOAT(cutoff_Hz)) {
      const bool filters = cutoff_Hz >= 1e-3f * rate && cutoff_Hz <= 0.45f * rate;
      lpf2_coef_t c = BEFORE;
      const status_t status = lpf2_tune(&c, cutoff_Hz, rate);
      if (filters && status == ST_OK)
        worst_of(&worst, error_of(&c, (double)cutoff_Hz, (double)rate), cutoff_Hz);
      else if (cutoff_Hz == 0.0f)
        ends_wrong += status != ST_OK || !same(&c, &OFF);
      else
        ends_wrong += status != ST_BAD_PARAM || !same(&c, &BEFORE);
    }
    ROW("%g Hz, worst at %.9g", (double)rate, (double)worst.at);
    CHECK_NEAR(worst.error, 0.0, 3e-6);
    CHECK(ends_wrong == 0);
  }
}
