// test_rls.c - the learner of the weights: golden values and a double oracle.
#include "base/lsq.h"
#include "flight/rls.h"
#include "rig/lesson.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#define N RBF_N

typedef struct {
  double w[N], P[N][N];
} oracle_t;

static oracle_t oracle_start(const rls_param_t *p, const rbf_weights_t *start) {
  oracle_t s = {{0}, {{0}}};
  for (int i = 0; i < N; i++) {
    s.w[i] = (double)start->w[i];
    s.P[i][i] = (double)p->p0;
  }
  return s;
}

// Joseph's form of the covariance, P = (1 - K a') P (1 - K a')' + K lambda K': other products than the
// flight code's, and positive definite by construction.
static void oracle_update(oracle_t *s, const rls_param_t *p, const lesson_t *x) {
  double Pa[N] = {0}, S = (double)p->lambda, error = (double)x->y;
  for (int i = 0; i < N; i++) {
    for (int j = 0; j < N; j++) Pa[i] += s->P[i][j] * (double)x->a[j];
    S += (double)x->a[i] * Pa[i];
    error -= s->w[i] * (double)x->a[i];
  }
  double half[N][N], whole[N][N];
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) half[i][j] = s->P[i][j] - Pa[i] / S * Pa[j];
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) {
      double ha = 0.0;
      for (int k = 0; k < N; k++) ha += half[i][k] * (double)x->a[k];
      whole[i][j] = half[i][j] - ha * Pa[j] / S + Pa[i] / S * (double)p->lambda * Pa[j] / S;
    }
  for (int i = 0; i < N; i++) {
    s->w[i] += Pa[i] / S * error;
    for (int j = 0; j < N; j++) s->P[i][j] = whole[i][j];
    if (p->form == RLS_RANDOM_WALK && s->P[i][i] < (double)p->p0) s->P[i][i] += (double)p->q;
  }
}

// 401 samples from 10 cm down to 2 cm, on the theory.
static lesson_t sweep(int k) {
  const double z = 0.10 - 0.0002 * k;
  return lesson_at(z, lesson_theory(z));
}

static const struct {
  rls_param_t p;
  double w[N], diag[N]; // diag 0: not given
} GOLDEN[] = {
    {{.lambda = 0.5f, .p0 = 1.0f},
     {1.014880, 2.012e-4, 9.959e-3, 6.7168e-2, 7.626e-3, -9.989e-3, -1.2477e-2},
     {.3451, 1.0000, .9582, .1117, .1586, .1838, .2589}},
    {{.lambda = 0.1f, .p0 = 1.0f},
     {1.015845, 6.169e-4, 2.6252e-2, 6.8561e-2, 6.061e-3, -1.0326e-2, -1.3553e-2},
     {0}},
    {{.lambda = 0.5f, .p0 = 5.0f},
     {1.015845, 6.169e-4, 2.6252e-2, 6.8561e-2, 6.061e-3, -1.0326e-2, -1.3553e-2},
     {0}},
    {{.lambda = 1.0f, .p0 = 0.1f},
     {1.012358, 4.578e-5, 2.869e-3, 3.7649e-2, 1.8966e-2, -1.0839e-2, -8.176e-3},
     {0}},
};
#define GOLDEN_COUNT (sizeof GOLDEN / sizeof *GOLDEN)

TEST(rls_gives_the_golden_weights_and_covariance) {
  for (unsigned row = 0; row < GOLDEN_COUNT; row++) {
    const rls_param_t *p = &GOLDEN[row].p;
    rls_t s;
    CHECK_OK(rls_init(&s, p, &lesson_flat));
    oracle_t oracle = oracle_start(p, &lesson_flat);
    for (int k = 0; k <= 400; k++) {
      const lesson_t x = sweep(k);
      CHECK_OK(rls_update(&s, p, x.a, x.y));
      oracle_update(&oracle, p, &x);
    }
    CHECK(s.count == 401);
    for (int i = 0; i < N; i++) {
      ROW("lambda %g p0 %g, w%d", (double)p->lambda, (double)p->p0, i + 1);
      // Four or five digits are printed, and float adds 1e-6.
      CHECK_NEAR(s.theta.w[i], GOLDEN[row].w[i], 5e-6);
      CHECK_NEAR(s.theta.w[i], oracle.w[i], 1e-5);
      CHECK_NEAR(s.P[i][i], oracle.P[i][i], 1e-5 * (double)p->p0);
      if (GOLDEN[row].diag[i] > 0.0) CHECK_NEAR(s.P[i][i], GOLDEN[row].diag[i], 6e-5);
    }
  }
}

TEST(rls_of_the_thesis_is_least_squares_with_a_prior) {
  // Minimise sum (y - a w)^2/lambda + |w - start|^2/p0 at once, by Eigen: no recursion at all.
  for (unsigned row = 0; row < GOLDEN_COUNT; row++) {
    const rls_param_t *p = &GOLDEN[row].p;
    static double A[401 + N][N], y[401 + N];
    rls_t s;
    CHECK_OK(rls_init(&s, p, &lesson_flat));
    for (int k = 0; k <= 400; k++) {
      const lesson_t x = sweep(k);
      CHECK_OK(rls_update(&s, p, x.a, x.y));
      for (int i = 0; i < N; i++) A[k][i] = (double)x.a[i] / sqrt((double)p->lambda);
      y[k] = (double)x.y / sqrt((double)p->lambda);
    }
    for (int i = 0; i < N; i++) {
      for (int j = 0; j < N; j++) A[401 + i][j] = i == j ? 1.0 / sqrt((double)p->p0) : 0.0;
      y[401 + i] = (double)lesson_flat.w[i] / sqrt((double)p->p0);
    }
    double w[N];
    lsq_solve(401 + N, N, &A[0][0], y, w);
    for (int i = 0; i < N; i++) {
      ROW("lambda %g p0 %g, w%d", (double)p->lambda, (double)p->p0, i + 1);
      CHECK_NEAR(s.theta.w[i], w[i], 1e-5);
    }
  }
}

TEST(rls_of_the_thesis_depends_on_lambda_over_p0_alone) {
  static const struct {
    float scale;
    double tol; // a power of two changes no digit
  } row[] = {{4.0f, 0.0}, {0.125f, 0.0}, {5.0f, 1e-5}, {0.02f, 1e-5}};
  for (unsigned k = 0; k < sizeof row / sizeof *row; k++) {
    ROW("scale %g", (double)row[k].scale);
    const rls_param_t scaled = {.lambda = row[k].scale * lesson_thesis.lambda,
                                .p0 = row[k].scale * lesson_thesis.p0};
    rls_t one, other;
    CHECK_OK(rls_init(&one, &lesson_thesis, &lesson_flat));
    CHECK_OK(rls_init(&other, &scaled, &lesson_flat));
    for (int i = 0; i <= 400; i++) {
      const lesson_t x = sweep(i);
      CHECK_OK(rls_update(&one, &lesson_thesis, x.a, x.y));
      CHECK_OK(rls_update(&other, &scaled, x.a, x.y));
    }
    for (int i = 0; i < N; i++) CHECK_NEAR(other.theta.w[i], one.theta.w[i], row[k].tol);
  }
}

TEST(rls_covariance_shrinks_only_where_data_comes_near_a_centre) {
  // Claim 23: samples from 10 to 2 cm say nothing of the bell at 0 mm and little of that at 5 mm.
  static const double sd_mm[N] = {0, 0, 5, 15, 30, 60, 100}; // centres
  rls_t s;
  CHECK_OK(rls_init(&s, &lesson_thesis, &lesson_flat));
  float at_35_mm = 0.0f;
  for (int k = 0; k <= 400; k++) {
    const lesson_t x = sweep(k);
    CHECK_OK(rls_update(&s, &lesson_thesis, x.a, x.y));
    if (k == 325) at_35_mm = s.P[3][3];
  }
  ROW("centre 0 mm");
  CHECK_NEAR(s.P[1][1], 1.000, 5e-4);
  ROW("centre 5 mm");
  CHECK_NEAR(s.P[2][2], 0.958, 5e-4);
  ROW("centre 15 mm, which fell late");
  CHECK_NEAR(s.P[3][3], 0.112, 5e-4);
  CHECK(at_35_mm > 0.7f);
  for (int i = 4; i < N; i++) {
    ROW("centre %g mm, visited", sd_mm[i]);
    CHECK(s.P[i][i] < 0.3f);
  }
}

TEST(rls_in_float_stays_with_the_one_in_double) {
  static const struct {
    const rls_param_t *p;
    double tol;
  } row[] = {{&lesson_thesis, 1e-4}, {&lesson_walk, 1e-2}};
  for (unsigned i = 0; i < 2; i++) {
    rls_t s;
    CHECK_OK(rls_init(&s, row[i].p, &lesson_flat));
    oracle_t oracle = oracle_start(row[i].p, &lesson_flat);
    splitmix_t r = {5};
    for (int k = 0; k < 10 * LESSON_MINUTE; k++) {
      const double z = 0.05 + splitmix_normal(&r, 0.002);
      const lesson_t x = lesson_at(z, lesson_theory(z) + splitmix_normal(&r, 0.02));
      CHECK_OK(rls_update(&s, row[i].p, x.a, x.y));
      oracle_update(&oracle, row[i].p, &x);
    }
    for (int k = 0; k < N; k++) {
      ROW("form %d, w%d", (int)row[i].p->form, k + 1);
      CHECK_NEAR(s.theta.w[k], oracle.w[k], row[i].tol);
    }
  }
}
