// rls.c - recursive least squares, seven weights.
#include "flight/rls.h"

#include "flight/v3.h"
#include <limits.h>

static float dot(const float a[RBF_N], const float b[RBF_N]) {
  float sum = 0.0f;
  for (int i = 0; i < RBF_N; i++) sum += a[i] * b[i];
  return sum;
}

static status_t param_check(const rls_param_t *p) {
  if (p->form != RLS_THESIS && p->form != RLS_RANDOM_WALK) return ST_BAD_PARAM;
  if (!(p->lambda >= 1e-6f && p->lambda <= 1e6f)) return ST_BAD_PARAM;
  if (!(p->p0 >= 1e-6f && p->p0 <= 1e6f)) return ST_BAD_PARAM;
  if (!(p->q >= 0.0f && p->q <= p->p0)) return ST_BAD_PARAM;
  return ST_OK;
}

static bool in_box(const rbf_weights_t *w) {
  for (int i = 0; i < RBF_N; i++)
    if (!(fabsf(w->w[i]) <= RLS_WEIGHT_MAX)) return false; // NaN fails this too
  return true;
}

static void restart(rls_t *s, float p0) {
  s->p0 = p0;
  for (int i = 0; i < RBF_N; i++)
    for (int j = 0; j < RBF_N; j++) s->P[i][j] = i == j ? p0 : 0.0f;
}

// Scales P down to the new p0. Only lambda/p0 matters: p0 is the unit of P.
static void lower(rls_t *s, float p0) {
  const float k = p0 / s->p0;
  for (int i = 0; i < RBF_N; i++)
    for (int j = 0; j < RBF_N; j++) s->P[i][j] *= k;
}

// True if P can be a covariance: diagonal between 0 and p0, P_ij^2 <= P_ii P_jj, and a sample's a' P a >= 0.
static bool is_covariance(const rls_t *s, float p0, float aPa) {
  for (int i = 0; i < RBF_N; i++) {
    if (!(s->P[i][i] > 0.0f && s->P[i][i] <= 1.1f * p0)) return false;
    for (int j = 0; j < RBF_N; j++)
      if (!(s->P[i][j] * s->P[i][j] <= 1.1f * s->P[i][i] * s->P[j][j])) return false;
  }
  return aPa >= 0.0f && aPa <= FLT_MAX;
}

status_t rls_check(const rls_param_t *p, const rbf_weights_t *start) {
  TRY(param_check(p));
  return in_box(start) ? ST_OK : ST_BAD_INPUT;
}

status_t rls_init(rls_t *s, const rls_param_t *p, const rbf_weights_t *start) {
  TRY(rls_check(p, start));
  s->theta = *start;
  s->count = 0;
  restart(s, p->p0);
  return ST_OK;
}

status_t rls_update(rls_t *s, const rls_param_t *p, const float a[RBF_N], float y) {
  TRY(param_check(p));
  if (!f_finite(y) || !f_finite(dot(a, a))) return ST_BAD_INPUT;
  if (p->p0 < s->p0) lower(s, p->p0);
  s->p0 = p->p0;

  float Pa[RBF_N];
  for (int i = 0; i < RBF_N; i++) Pa[i] = dot(s->P[i], a);
  const float aPa = dot(a, Pa);
  if (!is_covariance(s, p->p0, aPa) || !in_box(&s->theta)) {
    restart(s, p->p0);
    // To 0, as the bound would be no better guess: weights are a few tenths.
    for (int i = 0; i < RBF_N; i++)
      if (!(fabsf(s->theta.w[i]) <= RLS_WEIGHT_MAX)) s->theta.w[i] = 0.0f;
    return ST_SINGULAR;
  }
  const float inv_s = 1.0f / (aPa + p->lambda);
  const float step = inv_s * (y - dot(s->theta.w, a));

  rbf_weights_t theta;
  for (int i = 0; i < RBF_N; i++) theta.w[i] = s->theta.w[i] + Pa[i] * step;
  if (!in_box(&theta)) return ST_BAD_INPUT;
  s->theta = theta;

  for (int i = 0; i < RBF_N; i++) {
    // Both triangles get the same product, so that P stays symmetric to the bit.
    for (int j = 0; j <= i; j++) s->P[i][j] = s->P[j][i] = s->P[i][j] - Pa[i] * Pa[j] * inv_s;
    // Bounded: an endless walk would be wind-up.
    if (p->form == RLS_RANDOM_WALK) s->P[i][i] = f_min(s->P[i][i] + p->q, p->p0);
  }
  if (s->count < UINT_MAX) s->count++;
  return ST_OK;
}
