// rbf.c - the thrust ratio over the ceiling distance.
#include "flight/rbf.h"

#include "flight/expneg.h"

static const float WIDTH_PER_M2[RBF_N] = {0.0f, 15000.0f, 10000.0f, 5000.0f, 2000.0f, 1250.0f, 1000.0f};
static const float CENTRE_M[RBF_N] = {0.0f, 0.0f, 0.005f, 0.015f, 0.03f, 0.06f, 0.1f};

void rbf_basis(float zc_m, float basis[RBF_N]) {
  basis[0] = 1.0f;
  for (int i = 1; i < RBF_N; i++) {
    const float d = zc_m - CENTRE_M[i];
    basis[i] = expneg(WIDTH_PER_M2[i] * d * d);
  }
}

rbf_point_t rbf_at(const rbf_weights_t *w, float zc_m) {
  float basis[RBF_N];
  rbf_basis(zc_m, basis);
  rbf_point_t at = {.ratio = w->w[0], .slope_per_m = 0.0f};
  for (int i = 1; i < RBF_N; i++) {
    const float bell = w->w[i] * basis[i];
    at.ratio += bell;
    at.slope_per_m += -2.0f * bell * WIDTH_PER_M2[i] * (zc_m - CENTRE_M[i]);
  }
  return at;
}
