// rbf.c - the thrust ratio over the ceiling distance.
#include "flight/rbf.h"

#include "flight/expneg.h"
#include <math.h>

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

// Solves A x = b for symmetric positive definite A (with these centres its least pivot is 1e-3), in place, by
// Cholesky's L L' = A.
static void solve_spd(float A[RBF_N][RBF_N], float b[RBF_N]) {
  for (int j = 0; j < RBF_N; j++) {
    for (int k = 0; k < j; k++) A[j][j] -= A[j][k] * A[j][k];
    A[j][j] = sqrtf(A[j][j]);
    for (int i = j + 1; i < RBF_N; i++) {
      for (int k = 0; k < j; k++) A[i][j] -= A[i][k] * A[j][k];
      A[i][j] /= A[j][j];
    }
  }
  for (int i = 0; i < RBF_N; i++) {
    for (int k = 0; k < i; k++) b[i] -= A[i][k] * b[k];
    b[i] /= A[i][i];
  }
  for (int i = RBF_N - 1; i >= 0; i--) {
    for (int k = i + 1; k < RBF_N; k++) b[i] -= A[k][i] * b[k];
    b[i] /= A[i][i];
  }
}

status_t rbf_fit_theory(rbf_weights_t *w, float ca, float cb_per_m) {
  if (!(ca >= 0.0f && ca <= 5.0f) || !(cb_per_m > 0.0f && cb_per_m <= 1000.0f)) return ST_BAD_PARAM;
  float A[RBF_N][RBF_N] = {{0.0f}}, b[RBF_N] = {0.0f};
  for (int point = 0; point <= 20; point++) {
    const float zc_m = 0.005f * (float)point;
    float basis[RBF_N];
    rbf_basis(zc_m, basis);
    // The excess over 1 is fitted, and 1 added back: the digits of the small numbers count.
    const float excess = ca * expneg(cb_per_m * zc_m);
    for (int i = 0; i < RBF_N; i++) {
      b[i] += basis[i] * excess;
      for (int j = 0; j < RBF_N; j++) A[i][j] += basis[i] * basis[j];
    }
  }
  solve_spd(A, b);
  for (int i = 0; i < RBF_N; i++) w->w[i] = b[i];
  w->w[0] += 1.0f;
  return ST_OK;
}
