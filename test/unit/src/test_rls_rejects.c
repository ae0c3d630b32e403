// test_rls_rejects.c - what the learner cannot use, and a flipped bit in P (faults row 34).
#include "flight/rls.h"
#include "rig/lesson.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <float.h>
#include <string.h>

#define N RBF_N

TEST(rls_rejects_a_sample_it_cannot_use_and_keeps_its_state) {
  static const float bad[] = {NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX, 1e20f};
  const rls_param_t *form[] = {&lesson_thesis, &lesson_walk};
  for (int f = 0; f < 2; f++) {
    rls_t s;
    CHECK_OK(rls_init(&s, form[f], &lesson_flat));
    lesson_hover(&s, form[f], 0.03, 1.0, 200, 8);
    for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++)
      for (int field = 0; field <= N; field++) {
        ROW("form %d, %g in field %d", f, (double)bad[k], field);
        lesson_t x = lesson_at(0.03, 1.04);
        *(field < N ? &x.a[field] : &x.y) = bad[k];
        const rls_t before = s;
        CHECK_STATUS(ST_BAD_INPUT, rls_update(&s, form[f], x.a, x.y));
        CHECK(memcmp(&s, &before, sizeof s) == 0);
      }
  }
}

TEST(rls_rejects_a_jump_out_of_the_box_of_weights) {
  rls_t s;
  CHECK_OK(rls_init(&s, &lesson_walk, &lesson_flat));
  const rls_t before = s;
  const lesson_t x = lesson_at(0.5, 50.0);
  CHECK_STATUS(ST_BAD_INPUT, rls_update(&s, &lesson_walk, x.a, x.y));
  CHECK(memcmp(&s, &before, sizeof s) == 0);
}

TEST(rls_learns_nothing_from_a_regressor_of_zeros) {
  const rls_param_t *form[] = {&lesson_thesis, &lesson_walk};
  static const float zero[N] = {0};
  for (int f = 0; f < 2; f++) {
    ROW("form %d", f);
    rls_t s;
    CHECK_OK(rls_init(&s, form[f], &lesson_flat));
    lesson_hover(&s, form[f], 0.03, 1.0, 200, 9);
    const rls_t before = s;
    for (int k = 0; k < 10 * LESSON_MINUTE; k++) CHECK_OK(rls_update(&s, form[f], zero, 0.0f));
    CHECK(memcmp(&s.theta, &before.theta, sizeof s.theta) == 0);
    lesson_run_t run = {.first_bad = lesson_all_finite(&s) ? -1 : 0, .symmetric = true, .eigen_min = DBL_MAX};
    lesson_watch(&run, &s);
    CHECK(lesson_keeps_its_properties(&run, form[f]));
  }
}

TEST(rls_weights_stay_finite_whatever_comes) {
  static const float odd[] = {0.0f,  -0.0f, 1e-45f, 1e-38f, 1.0f, -1.0f,
                              1e10f, 1e18f, 1e19f,  3e38f,  NAN,  INFINITY};
  const unsigned odds = sizeof odd / sizeof *odd;
  splitmix_t r = {10};
  for (int f = 0; f < 2; f++) {
    rls_t s;
    CHECK_OK(rls_init(&s, f ? &lesson_walk : &lesson_thesis, &lesson_flat));
    int bad = 0;
    for (int k = 0; k < 50000; k++) {
      lesson_t x = lesson_at(splitmix_between(&r, 0.0, 0.15), splitmix_between(&r, 0.5, 2.0));
      for (int i = 0; i < N; i++)
        if (splitmix_bits(&r) % 8 == 0) x.a[i] = odd[splitmix_bits(&r) % odds];
      if (splitmix_bits(&r) % 4 == 0) x.y = odd[splitmix_bits(&r) % odds];
      const status_t status = rls_update(&s, f ? &lesson_walk : &lesson_thesis, x.a, x.y);
      if (status == ST_BAD_PARAM) bad++;
      for (int i = 0; i < N; i++)
        if (!(fabsf(s.theta.w[i]) <= RLS_WEIGHT_MAX)) bad++;
    }
    ROW("form %d", f);
    CHECK(bad == 0);
  }
}

TEST(rls_rejects_parameters_and_starts_it_cannot_use) {
  static const struct {
    const char *what;
    rls_param_t p;
  } row[] = {
      {"form 2", {.form = 2, .lambda = 1, .p0 = 1}},
      {"form -1", {.form = -1, .lambda = 1, .p0 = 1}},
      {"lambda zero", {.lambda = 0, .p0 = 1}},
      {"lambda negative", {.lambda = -1, .p0 = 1}},
      {"lambda nan", {.lambda = NAN, .p0 = 1}},
      {"lambda infinite", {.lambda = INFINITY, .p0 = 1}},
      {"p0 zero", {.lambda = 1, .p0 = 0}},
      {"p0 negative", {.lambda = 1, .p0 = -1}},
      {"p0 nan", {.lambda = 1, .p0 = NAN}},
      {"p0 infinite", {.lambda = 1, .p0 = INFINITY}},
      {"q negative", {.form = 1, .lambda = 1, .p0 = 1, .q = -1e-6f}},
      {"q above p0", {.form = 1, .lambda = 1, .p0 = 1, .q = 2}},
      {"q nan", {.form = 1, .lambda = 1, .p0 = 1, .q = NAN}},
  };
  const lesson_t x = lesson_at(0.03, 1.04);
  rls_t s;
  CHECK_OK(rls_init(&s, &lesson_walk, &lesson_flat));
  lesson_hover(&s, &lesson_walk, 0.03, 1.0, 100, 11);
  const rls_t before = s;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK_STATUS(ST_BAD_PARAM, rls_update(&s, &row[i].p, x.a, x.y));
    CHECK_STATUS(ST_BAD_PARAM, rls_init(&s, &row[i].p, &lesson_flat));
    CHECK(memcmp(&s, &before, sizeof s) == 0);
  }
  static const float bad[] = {5.1f, -5.1f, NAN, INFINITY};
  for (unsigned i = 0; i < sizeof bad / sizeof *bad; i++) {
    ROW("start weight %g", (double)bad[i]);
    rbf_weights_t start = lesson_flat;
    start.w[i] = bad[i];
    CHECK_STATUS(ST_BAD_INPUT, rls_init(&s, &lesson_walk, &start));
    CHECK(memcmp(&s, &before, sizeof s) == 0);
  }
}

TEST(rls_starts_again_when_p_is_no_covariance) {
  static const struct {
    const char *what;
    int i, j;
    float value;
  } row[] = {
      {"diagonal negative", 3, 3, -1.0f},
      {"diagonal zero", 3, 3, 0.0f},
      {"diagonal zero, not excited", 1, 1, 0.0f},
      {"diagonal nan", 6, 6, NAN},
      {"diagonal infinite", 0, 0, INFINITY},
      {"beside the diagonal nan", 4, 2, NAN},
      {"beside the diagonal infinite", 5, 6, INFINITY},
  };
  for (unsigned k = 0; k < sizeof row / sizeof *row; k++) {
    ROW("%s", row[k].what);
    rls_t s;
    CHECK_OK(rls_init(&s, &lesson_walk, &lesson_flat));
    lesson_hover(&s, &lesson_walk, 0.03, 1.0, 1000, 12);
    const rbf_weights_t learned = s.theta;
    s.P[row[k].i][row[k].j] = row[k].value;
    const lesson_t x = lesson_at(0.03, lesson_theory(0.03));
    CHECK_STATUS(ST_SINGULAR, rls_update(&s, &lesson_walk, x.a, x.y));
    CHECK(memcmp(&s.theta, &learned, sizeof learned) == 0);
    for (int i = 0; i < N; i++)
      for (int j = 0; j < N; j++) CHECK(s.P[i][j] == (i == j ? lesson_walk.p0 : 0.0f));
    CHECK_OK(rls_update(&s, &lesson_walk, x.a, x.y));
  }
}

TEST(rls_makes_a_skew_p_symmetric_in_one_sample) {
  rls_t s;
  CHECK_OK(rls_init(&s, &lesson_walk, &lesson_flat));
  lesson_hover(&s, &lesson_walk, 0.03, 1.0, 1000, 13);
  s.P[2][5] += 1e-3f;
  s.P[5][2] -= 1e-3f;
  const lesson_t x = lesson_at(0.03, lesson_theory(0.03));
  CHECK_OK(rls_update(&s, &lesson_walk, x.a, x.y));
  lesson_run_t run = {.symmetric = true};
  lesson_watch(&run, &s);
  CHECK(run.symmetric);
}

TEST(rls_recovers_from_any_flipped_bit_of_p) {
  // One bit of one number of P; then a second of hovering at 10 cm, where the bells of the near centres are
  // not excited, and a second at 2 cm, where they are.
  const rls_param_t *form[] = {&lesson_thesis, &lesson_walk};
  for (int f = 0; f < 2; f++) {
    rls_t trained;
    CHECK_OK(rls_init(&trained, form[f], &lesson_flat));
    lesson_hover(&trained, form[f], 0.03, 1.0, 1000, 14);
    for (int place = 0; place < N * N; place++)
      for (int bit = 0; bit < 32; bit++) {
        ROW("form %d, P[%d][%d], bit %d", f, place / N, place % N, bit);
        rls_t s = trained;
        uint32_t word;
        memcpy(&word, &s.P[place / N][place % N], sizeof word);
        word ^= (uint32_t)1 << bit;
        memcpy(&s.P[place / N][place % N], &word, sizeof word);
        splitmix_t r = {15};
        int refused = 0;
        for (int k = 0; k < 200; k++) {
          const double z = (k < 100 ? 0.1 : 0.02) + splitmix_normal(&r, 0.002);
          const lesson_t x = lesson_at(z, lesson_theory(z) + splitmix_normal(&r, 0.02));
          if (rls_update(&s, form[f], x.a, x.y) != ST_OK) refused++;
          if (!lesson_all_finite(&s)) refused += 1000;
        }
        CHECK(refused <= 3);
        lesson_run_t run = {.first_bad = -1, .symmetric = true, .eigen_min = DBL_MAX};
        lesson_watch(&run, &s);
        CHECK(run.symmetric && run.w_max <= 5.0);
        CHECK(run.eigen_max <= 4.0 * (double)form[f]->p0); // a number that doubled may be a true one
        CHECK_NEAR(lesson_curve(&s, 0.02), lesson_theory(0.02), 0.05);
      }
  }
}
