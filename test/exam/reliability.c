// reliability.c - stated probabilities against the share that was right.
#include "exam/reliability.h"

#include <math.h>

#define Z90 1.6448536 // standard deviations: 5 % lie beyond on each side

static const double LEAST[RELIABILITY_BINS + 1] = {0.0, 0.5, 0.8, 0.95, 1.0};

void reliability_add(reliability_t *r, double stated, bool right) {
  if (!(stated >= 0.0 && stated <= 1.0)) {
    r->unstated++;
    return;
  }
  int i = RELIABILITY_BINS - 1;
  while (stated < LEAST[i]) i--;
  r->bin[i].of++;
  r->bin[i].right += right;
  r->bin[i].stated += stated;
}

void reliability_join(reliability_t *r, const reliability_t *other) {
  for (int i = 0; i < RELIABILITY_BINS; i++) {
    r->bin[i].of += other->bin[i].of;
    r->bin[i].right += other->bin[i].right;
    r->bin[i].stated += other->bin[i].stated;
  }
  r->unstated += other->unstated;
}

void reliability_interval(int right, int of, double *from, double *to) {
  const double n = of, p = right / n, z2 = Z90 * Z90;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = Z90 * sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n)) / (1.0 + z2 / n);
  *from = fmax(middle - half, 0.0);
  *to = fmin(middle + half, 1.0);
}

void reliability_print(const reliability_t *r, FILE *out) {
  fprintf(out, "  stated           mean       right            90 %% interval\n");
  for (int i = 0; i < RELIABILITY_BINS; i++) {
    const int of = r->bin[i].of, right = r->bin[i].right;
    fprintf(out, "  %-4g to %-4g", LEAST[i], LEAST[i + 1]);
    if (!of) {
      fprintf(out, "         -    0/0\n");
      continue;
    }
    double from, to;
    reliability_interval(right, of, &from, &to);
    fprintf(out, "     %.3f %4d/%-4d %5.1f %%   %5.1f to %5.1f %%\n", r->bin[i].stated / of, right, of,
            100.0 * right / of, 100.0 * from, 100.0 * to);
  }
  fprintf(out, "  names without a probability: %d\n", r->unstated);
}
