// test_gap_shape.c - shapes of named effects that lie between the ones that are tried.
#include "gap_case.h"
#include "test.h"

static gap_case_t *diagnosed(const fx_use_t *use) {
  const gap_hidden_t hidden = {1, {*use}};
  return gap_case(&hidden, &hidden);
}

static const fx_use_t *only_one(const gap_case_t *c, const char *name) {
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
    gap_case_t *const c = diagnosed(&hidden);
    const fx_use_t *const found = only_one(c, "ceiling");
    const named_t *const named = &c->d.found.named[0];
    if (found) {
      CHECK(named->shape_stderr > 0.0 && named->shape_stderr < 0.1 * decay[i]);
      CHECK_NEAR(found->p[1], decay[i], 3.0 * named->shape_stderr);
      CHECK_NEAR(found->p[0], 0.3, 0.25 * 0.3); // errors of the estimated height flatten the curve
      CHECK(named->value[0] == found->p[0] && named->stderr_[0] < 0.05);
    }
    gap_case_free(c);
  }
}

TEST(gap_leaves_the_number_of_a_rotor_a_number) {
  fx_use_t hidden = fx_use(fx_find("motor_damage"));
  hidden.p[0] = 3.0;
  gap_case_t *const c = diagnosed(&hidden);
  const fx_use_t *const found = only_one(c, "motor_damage");
  if (found) CHECK(found->p[0] == 3.0 && c->d.found.named[0].shape_stderr == 0.0);
  gap_case_free(c);
}
