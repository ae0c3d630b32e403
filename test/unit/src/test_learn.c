// test_learn.c - which samples the curve may learn from.
#include "flight/learn.h"
#include "rig/test.h"

#include <stddef.h>
#include <string.h>

static const learn_param_t P = {.rls = {.form = RLS_RANDOM_WALK, .lambda = 1.0f, .p0 = 10.0f, .q = 1e-6f},
                                .near_m = 0.005f,
                                .far_m = 0.5f,
                                .blind_max_s = 3.0f,
                                .up_min = 0.97f,
                                .thrust_min = 0.3f,
                                .settle_s = 0.2f,
                                .y_max = 2.5f};
static const rbf_weights_t FLAT = {{1, 0, 0, 0, 0, 0, 0}};
static const learn_sample_t GOOD = {.zc_m = 0.03f,
                                    .known = true,
                                    .blind_s = 0.5f,
                                    .up = 0.999f,
                                    .force_N = 0.33f,
                                    .thrust_N = 0.30f,
                                    .weight_N = 0.314f,
                                    .since_limit_s = 5.0f};

static learn_t fresh(void) {
  learn_t s;
  CHECK_OK(learn_init(&s, &P, &FLAT));
  return s;
}

TEST(learner_begins_without_a_sample_whatever_was_there) {
  learn_t s;
  memset(&s, 0x55, sizeof s);
  CHECK_OK(learn_init(&s, &P, &FLAT));
  CHECK(s.y == 0.0f && s.refused == 0u);
}

// Whether the sample is learned from; if not, nothing but the counter of refusals may have changed.
static bool is_learned_from(const learn_sample_t *x) {
  learn_t s = fresh();
  const learn_t before = s;
  const status_t status = learn_update(&s, &P, x, 0.0f);
  if (status == ST_OK) {
    CHECK(s.rls.count == 1 && s.refused == 0);
    CHECK(memcmp(&s.rls.theta, &before.rls.theta, sizeof s.rls.theta) != 0);
    return true;
  }
  CHECK_STATUS(ST_SAMPLE_REFUSED, status);
  CHECK(memcmp(&s.rls, &before.rls, sizeof s.rls) == 0);
  CHECK(s.refused == 1);
  return false;
}

enum { ZC = offsetof(learn_sample_t, zc_m), BLIND = offsetof(learn_sample_t, blind_s) };
enum { UP = offsetof(learn_sample_t, up), FORCE = offsetof(learn_sample_t, force_N) };
enum { THRUST = offsetof(learn_sample_t, thrust_N), WEIGHT = offsetof(learn_sample_t, weight_N) };
enum { LIMIT = offsetof(learn_sample_t, since_limit_s) };

static const struct {
  const char *what;
  size_t field;
  float value;
  bool learned;
} GATES[] = {
    {"good", ZC, 0.03f, true},
    {"at the nearest", ZC, 0.005f, true},
    {"in contact", ZC, 0.0049f, false},
    {"at the farthest", ZC, 0.5f, true},
    {"too far", ZC, 0.501f, false},
    {"just not blind", BLIND, 3.0f, true},
    {"blind", BLIND, 3.01f, false},
    {"just not tilted", UP, 0.97f, true},
    {"tilted", UP, 0.969f, false},
    {"upside down", UP, -1.0f, false},
    {"ratio just below the largest", FORCE, 0.749f, true},
    {"bump", FORCE, 0.751f, false},
    {"ratio just above the smallest", FORCE, 0.1201f, true},
    {"dropped", FORCE, 0.1199f, false},
    {"pushed down", FORCE, -0.33f, false},
    {"free fall", FORCE, 0.0f, false},
    {"motors off", THRUST, 0.0f, false},
    {"negative thrust", THRUST, -0.3f, false},
    {"no weight", WEIGHT, 0.0f, false},
    {"negative weight", WEIGHT, -0.314f, false},
    {"heavy enough to be on the ground", WEIGHT, 1.1f, false},
    {"limit just long ago", LIMIT, 0.2f, true},
    {"limit a moment ago", LIMIT, 0.19f, false},
    {"at the limit", LIMIT, 0.0f, false},
};

TEST(learn_takes_a_sample_only_within_every_gate) {
  for (unsigned i = 0; i < sizeof GATES / sizeof *GATES; i++) {
    ROW("%s", GATES[i].what);
    learn_sample_t x = GOOD;
    memcpy((char *)&x + GATES[i].field, &GATES[i].value, sizeof(float));
    CHECK(is_learned_from(&x) == GATES[i].learned);
  }
  ROW("no ceiling known");
  learn_sample_t x = GOOD;
  x.known = false;
  CHECK(!is_learned_from(&x));
}

TEST(learn_takes_no_thrust_below_the_smallest_even_if_the_ratio_is_good) {
  // Faults row 36: on the ground and in free fall both force and thrust are small.
  static const float share[] = {0.31f, 0.29f, 0.01f, 0.0f};
  for (unsigned i = 0; i < sizeof share / sizeof *share; i++) {
    ROW("thrust %g of the weight", (double)share[i]);
    learn_sample_t x = GOOD;
    x.thrust_N = share[i] * x.weight_N;
    x.force_N = 1.05f * x.thrust_N;
    CHECK(is_learned_from(&x) == (i == 0));
  }
}

TEST(learn_takes_no_sample_with_a_field_that_is_not_a_number) {
  for (size_t field = 0; field < sizeof(learn_sample_t); field += sizeof(float)) {
    if (field == offsetof(learn_sample_t, known)) continue;
    ROW("field at byte %d", (int)field);
    learn_sample_t x = GOOD;
    const float nan = NAN;
    memcpy((char *)&x + field, &nan, sizeof nan);
    CHECK(!is_learned_from(&x));
  }
}

TEST(learn_takes_no_infinite_ratio) {
  static const struct {
    const char *what;
    float force_N, thrust_N;
  } row[] = {{"force", INFINITY, 0.3f},
             {"thrust", 0.3f, INFINITY},
             {"both", INFINITY, INFINITY},
             {"force, downwards", -INFINITY, 0.3f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    learn_sample_t x = GOOD;
    x.force_N = row[i].force_N;
    x.thrust_N = row[i].thrust_N;
    CHECK(!is_learned_from(&x));
  }
}

TEST(learn_teaches_the_ratio_of_force_to_thrust_at_the_distance) {
  learn_t s = fresh();
  rls_t direct;
  CHECK_OK(rls_init(&direct, &P.rls, &FLAT));
  for (int k = 0; k < 200; k++) {
    learn_sample_t x = GOOD;
    x.zc_m = 0.02f + 0.0004f * (float)k;
    x.force_N = x.thrust_N * (1.0f + 0.44f * (0.1f - x.zc_m));
    CHECK_OK(learn_update(&s, &P, &x, 0.0f));
    float a[RBF_N];
    rbf_basis(x.zc_m, a);
    CHECK_OK(rls_update(&direct, &P.rls, a, x.force_N / x.thrust_N));
  }
  CHECK(memcmp(&s.rls, &direct, sizeof direct) == 0);
  CHECK_NEAR(rbf_at(&s.rls.theta, 0.04f).ratio, 1.0264, 5e-3);
}

TEST(learn_hands_on_what_rls_says) {
  learn_t s = fresh();
  learn_param_t bad = P;
  bad.rls.lambda = NAN;
  const learn_t before = s;
  CHECK_STATUS(ST_BAD_PARAM, learn_update(&s, &bad, &GOOD, 0.0f));
  CHECK_STATUS(ST_BAD_PARAM, learn_init(&s, &bad, &FLAT));
  const rbf_weights_t wild = {{1, 0, NAN, 0, 0, 0, 0}};
  CHECK_STATUS(ST_BAD_INPUT, learn_init(&s, &P, &wild));
  CHECK(memcmp(&s, &before, sizeof s) == 0);
}
