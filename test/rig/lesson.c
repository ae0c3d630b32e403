// lesson.c - training data for the learner in tests.
#include "rig/lesson.h"

#include "rig/oracle.h"
#include "rig/splitmix.h"
#include "rig/test.h"
#include <float.h>
#include <string.h>

#define N RBF_N

const rbf_weights_t lesson_flat = {{1, 0, 0, 0, 0, 0, 0}};
const rls_param_t lesson_thesis = {.form = RLS_THESIS, .lambda = 0.5f, .p0 = 1.0f};
const rls_param_t lesson_walk = {.form = RLS_RANDOM_WALK, .lambda = 1.0f, .p0 = 10.0f, .q = 1e-6f};

double lesson_theory(double z) {
  return 1.0 + 0.44 * exp(-80.0 * z);
}

lesson_t lesson_at(double z, double y) {
  lesson_t x = {.y = (float)y};
  rbf_basis((float)z, x.a);
  return x;
}

double lesson_curve(const rls_t *s, double z) {
  return (double)rbf_at(&s->theta, (float)z).ratio;
}

bool lesson_all_finite(const rls_t *s) {
  for (int i = 0; i < N; i++) {
    if (!isfinite(s->theta.w[i])) return false;
    for (int j = 0; j < N; j++)
      if (!isfinite(s->P[i][j])) return false;
  }
  return true;
}

void lesson_watch(lesson_run_t *run, const rls_t *s) {
  double P[N][N], value[N];
  for (int i = 0; i < N; i++) {
    run->w_max = fmax(run->w_max, fabs((double)s->theta.w[i]));
    for (int j = 0; j < N; j++) {
      P[i][j] = (double)s->P[i][j];
      if (memcmp(&s->P[i][j], &s->P[j][i], sizeof(float)) != 0) run->symmetric = false;
    }
  }
  oracle_eigenvalues((const double(*)[N])P, value);
  run->eigen_min = fmin(run->eigen_min, value[0]);
  run->eigen_max = fmax(run->eigen_max, value[N - 1]);
}

lesson_run_t lesson_hover_by(rls_t *s, lesson_update_fn *update, const rls_param_t *p, double z, double gain,
                             int samples, uint64_t seed) {
  splitmix_t r = {seed};
  lesson_run_t run = {.first_bad = -1, .symmetric = true, .eigen_min = DBL_MAX};
  for (int k = 0; k < samples && run.first_bad < 0; k++) {
    const double there = z + splitmix_normal(&r, 0.002);
    const lesson_t x = lesson_at(there, gain * lesson_theory(there) + splitmix_normal(&r, 0.02));
    CHECK_OK(update(s, p, x.a, x.y));
    if (!lesson_all_finite(s))
      run.first_bad = k;
    else if (k % 500 == 0 || k == samples - 1)
      lesson_watch(&run, s);
  }
  return run;
}

static status_t flight_update(rls_t *s, const rls_param_t *p, const float *a, float y) {
  return rls_update(s, p, a, y);
}

lesson_run_t lesson_hover(rls_t *s, const rls_param_t *p, double z_m, double gain, int samples,
                          uint64_t seed) {
  return lesson_hover_by(s, flight_update, p, z_m, gain, samples, seed);
}

bool lesson_keeps_its_properties(const lesson_run_t *run, const rls_param_t *p) {
  return run->first_bad < 0 && run->symmetric && run->eigen_min > 0.0 &&
         run->eigen_max <= 1.1 * (double)p->p0 && run->w_max <= 5.0;
}
