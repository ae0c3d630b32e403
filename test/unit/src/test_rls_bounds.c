// test_rls_bounds.c - the bounds of the learner: its parameters, its variance, its weights.
#include "flight/rls.h"
#include "rig/lesson.h"
#include "rig/test.h"

#include <string.h>

#define N RBF_N

TEST(rls_takes_parameters_up_to_their_limits) {
  static const struct {
    rls_param_t p;
    status_t want;
  } row[] = {
      {{.lambda = 1e-6f, .p0 = 1}, ST_OK},     {{.lambda = 0.99e-6f, .p0 = 1}, ST_BAD_PARAM},
      {{.lambda = 1e6f, .p0 = 1}, ST_OK},      {{.lambda = 1.01e6f, .p0 = 1}, ST_BAD_PARAM},
      {{.lambda = 1, .p0 = 1e-6f}, ST_OK},     {{.lambda = 1, .p0 = 0.99e-6f}, ST_BAD_PARAM},
      {{.lambda = 1, .p0 = 1e6f}, ST_OK},      {{.lambda = 1, .p0 = 1.01e6f}, ST_BAD_PARAM},
      {{.lambda = 1, .p0 = 1, .q = 1}, ST_OK}, {{.lambda = 1, .p0 = 1, .q = 1.01f}, ST_BAD_PARAM},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%u", i);
    rls_t s;
    CHECK_STATUS(row[i].want, rls_init(&s, &row[i].p, &lesson_flat));
  }
}

TEST(rls_walks_to_p0_and_no_farther_whatever_q) {
  // q = p0 once restarted the covariance at every second sample.
  static const float qs[] = {0.0f, 1e-6f, 1e-4f, 1e-3f};
  for (unsigned i = 0; i < sizeof qs / sizeof *qs; i++) {
    const rls_param_t p = {.form = RLS_RANDOM_WALK, .lambda = 1.0f, .p0 = 1e-3f, .q = qs[i]};
    rls_t s;
    CHECK_OK(rls_init(&s, &p, &lesson_flat));
    const lesson_t x = lesson_at(0.03, 1.04);
    for (int k = 0; k < 2000; k++) {
      ROW("q %g, sample %d", (double)qs[i], k);
      if (!CHECK_OK(rls_update(&s, &p, x.a, x.y))) break;
      for (int j = 0; j < N; j++) CHECK(s.P[j][j] > 0.0f && s.P[j][j] <= p.p0);
    }
    CHECK(s.count == 2000);
    CHECK((s.P[0][0] == p.p0) == (qs[i] > 0.0f)); // walks back what a sample takes
  }
}

TEST(rls_takes_another_p0_in_flight_for_no_flipped_bit) {
  static const rls_param_t *form[] = {&lesson_thesis, &lesson_walk};
  for (int f = 0; f < 2; f++) {
    ROW("form %d", f);
    rls_param_t p = *form[f];
    rls_t s;
    CHECK_OK(rls_init(&s, &p, &lesson_flat));
    lesson_hover(&s, &p, 0.03, 1.0, 200, 8);
    const rbf_weights_t learned = s.theta;
    const rls_t before = s;
    const float p0 = p.p0;
    p.p0 = 0.3f * p0;
    static const float zero[N] = {0};
    CHECK_OK(rls_update(&s, &p, zero, 0.0f));
    CHECK(memcmp(&s.theta, &learned, sizeof learned) == 0);
    for (int i = 0; i < N; i++)
      for (int j = 0; j < N; j++) {
        const double want = (double)(p.p0 / p0 * before.P[i][j]);
        CHECK_NEAR(s.P[i][j], i == j ? fmin(want + (double)p.q, (double)p.p0) : want, 1e-6 * (double)p.p0);
      }
    const lesson_run_t lower = lesson_hover(&s, &p, 0.03, 1.0, 200, 8);
    CHECK(lesson_keeps_its_properties(&lower, &p));
    p.p0 = p0; // and up again
    const unsigned count = s.count;
    lesson_hover(&s, &p, 0.03, 1.0, 200, 9);
    CHECK(s.count == count + 200);
  }
}

TEST(rls_starts_again_where_a_variance_or_a_weight_is_beyond_all_bounds) {
  static const struct {
    const char *what;
    float variance, weight; // of the third; 0: as learned
    bool singular;
  } row[] = {
      {"a tenth more than p0", 1.09f, 0, false},
      {"more than that", 1.11f, 0, true},
      {"variance zero", -1.0f, 0, true},
      {"weight 5", 0, 5.0f, false},
      {"weight 5.1", 0, 5.1f, true},
      {"weight -1e9", 0, -1e9f, true},
      {"weight NaN", 0, NAN, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    rls_t s;
    CHECK_OK(rls_init(&s, &lesson_walk, &lesson_flat));
    lesson_hover(&s, &lesson_walk, 0.03, 1.0, 200, 8);
    if (row[i].variance > 0.0f) s.P[2][2] = row[i].variance * lesson_walk.p0;
    if (row[i].variance < 0.0f) s.P[2][2] = 0.0f;
    if (!(row[i].weight == 0.0f)) s.theta.w[2] = row[i].weight;
    const rls_t before = s;
    static const float zero[N] = {0};
    CHECK_STATUS(row[i].singular ? ST_SINGULAR : ST_OK, rls_update(&s, &lesson_walk, zero, 0.0f));
    for (int j = 0; j < N; j++) {
      CHECK(s.theta.w[j] == (fabsf(before.theta.w[j]) <= RLS_WEIGHT_MAX ? before.theta.w[j] : 0.0f));
      if (row[i].singular)
        for (int k = 0; k < N; k++) CHECK(s.P[j][k] == (j == k ? lesson_walk.p0 : 0.0f));
    }
  }
}

TEST(rls_counts_samples_no_further_than_a_counter_goes) {
  rls_t s;
  CHECK_OK(rls_init(&s, &lesson_walk, &lesson_flat));
  const lesson_t x = lesson_at(0.03, 1.04);
  s.count = (unsigned)-2;
  CHECK_OK(rls_update(&s, &lesson_walk, x.a, x.y));
  CHECK_OK(rls_update(&s, &lesson_walk, x.a, x.y));
  CHECK(s.count == (unsigned)-1);
}
