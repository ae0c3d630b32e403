// test_gap_shape.c - shapes of named effects that lie between the ones that are tried.
#include "exam/flights.h"
#include "gap/diagnose.h"
#include "test.h"

#include <stdlib.h>

typedef struct {
  model_t given, truth;
  gap_flight_t flight[3];
  diagnosis_t d;
} case_t;

// Three flights with the effect hidden, the last one held out.
static case_t *diagnosed(const fx_use_t *hidden) {
  case_t *const c = calloc(1, sizeof *c);
  why_t why;
  if (!c) abort();
  CHECK_OK(exam_vehicle(&c->given, &why));
  c->truth = c->given;
  CHECK_OK(model_add_fx(&c->truth, hidden, &why));
  for (unsigned long i = 0; i < 3; i++) {
    const exam_flight_t job = {.truth = &c->truth, .seed = 70 + i};
    CHECK_OK(exam_fly(&job, &c->flight[i], &why));
  }
  const gap_flights_t fit = {c->flight, 2}, held = {c->flight + 2, 1};
  const diagnose_job_t job = {.fit = &fit, .held = &held, .model = &c->given, .seed = 1};
  CHECK_OK(diagnose(&job, &c->d, &why));
  return c;
}

static void drop(case_t *c) {
  diagnosis_free(&c->d);
  for (int i = 0; i < 3; i++) gap_flight_free(&c->flight[i]);
  free(c);
}

static const fx_use_t *only_one(const case_t *c, const char *name) {
  const fx_use_t *const use = &c->d.candidates.candidate[c->d.found.named[0].candidate].use;
  return CHECK(c->d.found.n == 1) && CHECK(use->fx == fx_find(name)) ? use : NULL;
}

TEST(gap_finds_a_ceilings_decay_between_those_that_it_tries) {
  static const double decay[] = {0.45, 0.8};
  for (unsigned i = 0; i < 2; i++) {
    ROW("Cb %g", decay[i]);
    fx_use_t hidden = fx_use(fx_find("ceiling"));
    hidden.p[0] = 0.3;
    hidden.p[1] = decay[i];
    case_t *const c = diagnosed(&hidden);
    const fx_use_t *const found = only_one(c, "ceiling");
    const named_t *const named = &c->d.found.named[0];
    if (found) {
      CHECK(named->shape_stderr > 0.0 && named->shape_stderr < 0.1 * decay[i]);
      CHECK_NEAR(found->p[1], decay[i], 3.0 * named->shape_stderr);
      CHECK_NEAR(found->p[0], 0.3, 0.25 * 0.3); // errors of the estimated height flatten the curve
      CHECK(named->value[0] == found->p[0] && named->stderr_[0] < 0.03);
    }
    drop(c);
  }
}

TEST(gap_leaves_the_number_of_a_rotor_a_number) {
  fx_use_t hidden = fx_use(fx_find("motor_damage"));
  hidden.p[0] = 3.0;
  case_t *const c = diagnosed(&hidden);
  const fx_use_t *const found = only_one(c, "motor_damage");
  if (found) CHECK(found->p[0] == 3.0 && c->d.found.named[0].shape_stderr == 0.0);
  drop(c);
}
