// bells.c - the curve of seven weights, written a second time, in double.
#include "rig/bells.h"

#include <math.h>

const double bells_golden[RBF_N] = {1.43142386,  0.15021046,  -0.09754395, -0.07601899,
                                    -0.26694495, -0.30407099, -0.37406497};

rbf_weights_t bells_golden_weights(void) {
  rbf_weights_t w;
  for (int i = 0; i < RBF_N; i++) w.w[i] = (float)bells_golden[i];
  return w;
}

void bells_at(double z, double basis[RBF_N]) {
  static const double width[RBF_N] = {0, 15000, 10000, 5000, 2000, 1250, 1000};
  static const double centre[RBF_N] = {0, 0, 0.005, 0.015, 0.03, 0.06, 0.1};
  for (int i = 0; i < RBF_N; i++) basis[i] = exp(-width[i] * (z - centre[i]) * (z - centre[i]));
}

double bells_ratio(const rbf_weights_t *w, double z) {
  double basis[RBF_N], sum = 0.0;
  bells_at(z, basis);
  for (int i = 0; i < RBF_N; i++) sum += (double)w->w[i] * basis[i];
  return sum;
}

double bells_slope(const rbf_weights_t *w, double z) {
  const double h = 1e-6;
  return (bells_ratio(w, z + h) - bells_ratio(w, z - h)) / (2.0 * h);
}

double bells_theory(double ca, double cb, double z) {
  return 1.0 + ca * exp(-cb * z);
}
