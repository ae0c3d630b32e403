// test_rls_long.c - the learner in long flights: what has to hold for any form of the update.
#include "flight/rls.h"
#include "rig/lesson.h"
#include "rig/bells.h"
#include "rig/test.h"

#define N RBF_N

// The mutant: lambda taken for a forgetting factor, P divided by it after every sample.
static status_t forgetting_update(rls_t *s, const rls_param_t *p, const float *a, float y) {
  float Pa[N] = {0}, sum = p->lambda, error = y;
  for (int i = 0; i < N; i++) {
    for (int j = 0; j < N; j++) Pa[i] += s->P[i][j] * a[j];
    sum += a[i] * Pa[i];
    error -= a[i] * s->theta.w[i];
  }
  for (int i = 0; i < N; i++) {
    s->theta.w[i] += Pa[i] / sum * error;
    for (int j = 0; j <= i; j++) s->P[i][j] = s->P[j][i] = (s->P[i][j] - Pa[i] * Pa[j] / sum) / p->lambda;
  }
  return ST_OK;
}

TEST(rls_random_walk_has_an_end) {
  // The largest q that may be set, for ten minutes in which six of the seven directions learn nothing.
  rls_param_t p = lesson_walk;
  p.q = 1e-3f;
  rls_t s;
  CHECK_OK(rls_init(&s, &p, &lesson_flat));
  const lesson_run_t run = lesson_hover(&s, &p, 1.5, 1.0, 10 * LESSON_MINUTE, 16);
  CHECK(lesson_keeps_its_properties(&run, &p));
}

TEST(rls_keeps_its_properties_in_long_flights) {
  static const struct {
    const char *what;
    double z;
    int samples;
  } row[] = {{"10 min at 5 cm", 0.05, 10 * LESSON_MINUTE},
             {"10 min at 2 cm", 0.02, 10 * LESSON_MINUTE},
             {"10 min at 0.5 m", 0.5, 10 * LESSON_MINUTE},
             {"1 h of free flight", 1.5, 60 * LESSON_MINUTE}};
  const rls_param_t *form[] = {&lesson_walk, &lesson_thesis};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (int k = 0; k < 2; k++) {
      ROW("%s, form %d", row[i].what, (int)form[k]->form);
      rls_t s;
      CHECK_OK(rls_init(&s, form[k], &lesson_flat));
      const lesson_run_t run = lesson_hover(&s, form[k], row[i].z, 1.0, row[i].samples, 3);
      CHECK(lesson_keeps_its_properties(&run, form[k]));
      CHECK_NEAR(lesson_curve(&s, row[i].z), lesson_theory(row[i].z), 0.01);
    }
}

TEST(rls_smallest_eigenvalue_stays_far_from_rounding) {
  // Measured by a prototype: 2e-5 for the thesis form, 6.8e-4 with the random walk.
  static const struct {
    const rls_param_t *p;
    double want;
  } row[] = {{&lesson_thesis, 1e-6}, {&lesson_walk, 3e-4}};
  for (unsigned i = 0; i < 2; i++) {
    ROW("form %d", (int)row[i].p->form);
    rls_t s;
    CHECK_OK(rls_init(&s, row[i].p, &lesson_flat));
    const lesson_run_t run = lesson_hover(&s, row[i].p, 0.05, 1.0, 10 * LESSON_MINUTE, 4);
    CHECK(run.eigen_min > row[i].want);
  }
}

TEST(rls_with_a_forgetting_factor_would_fail) {
  static const struct {
    float lambda;
    int samples;
    bool gone;
  } row[] = {{0.5f, 430, true}, {0.9f, 10 * LESSON_MINUTE, true}, {0.995f, 10 * LESSON_MINUTE, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("lambda %g", (double)row[i].lambda);
    const rls_param_t p = {.lambda = row[i].lambda, .p0 = 1.0f};
    rls_t s;
    CHECK_OK(rls_init(&s, &p, &lesson_flat));
    const lesson_run_t run = lesson_hover_by(&s, forgetting_update, &p, 0.05, 1.0, row[i].samples, 3);
    CHECK(!lesson_keeps_its_properties(&run, &p));
    CHECK(run.first_bad >= 0);
    if (i == 0) CHECK(run.first_bad <= 429);
  }
}

TEST(rls_with_a_random_walk_follows_a_drift) {
  // The thrust map drifts by -10 % between two hovers of equal length. The thesis form keeps the mean of both
  // (in float for some minutes only: then P has shrunk to its rounding, and that is a random walk, too).
  static const struct {
    const char *what;
    const rls_param_t *p;
    int minutes;
    double error, tol;
  } row[] = {{"random walk", &lesson_walk, 10, 0.0, 0.01},
             {"random walk, soon", &lesson_walk, 1, 0.0, 0.01},
             {"thesis", &lesson_thesis, 1, 0.051, 0.002}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    rls_t s;
    CHECK_OK(rls_init(&s, row[i].p, &lesson_flat));
    lesson_hover(&s, row[i].p, 0.05, 1.0, row[i].minutes * LESSON_MINUTE, 6);
    lesson_hover(&s, row[i].p, 0.05, 0.9, row[i].minutes * LESSON_MINUTE, 7);
    CHECK_NEAR(lesson_curve(&s, 0.05) - 0.9 * lesson_theory(0.05), row[i].error, row[i].tol);
  }
}

TEST(rls_does_not_throw_the_curve_when_the_vehicle_steps_to_3_cm) {
  // After 10 min in one place the other directions of P are wide; a new place must not move the curve far
  // where the vehicle is or was.
  for (uint64_t seed = 0; seed < 5; seed++) {
    ROW("seed %u", (unsigned)seed);
    const rbf_weights_t start = bells_golden_weights();
    rls_t s;
    CHECK_OK(rls_init(&s, &lesson_walk, &start));
    lesson_hover(&s, &lesson_walk, 0.05, 1.0, 10 * LESSON_MINUTE, 20 + seed);
    const rls_t before = s;
    double moved = 0.0;
    for (int k = 0; k < 100; k++) {
      lesson_hover(&s, &lesson_walk, 0.03, 1.0, 10, 1000 * seed + (uint64_t)k);
      for (int mm = 30; mm <= 60; mm++)
        moved = fmax(moved, fabs(lesson_curve(&s, 1e-3 * mm) - lesson_curve(&before, 1e-3 * mm)));
    }
    CHECK_NEAR(moved, 0.0, 0.05);
    CHECK(moved > 1e-3); // or it learns nothing
  }
}
