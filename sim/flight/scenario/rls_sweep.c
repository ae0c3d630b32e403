// rls_sweep.c - the thesis's figures B.11 to B.20: the samples of one learning flight, learned with seven
// pairs of lambda and p0. In the thesis's form only lambda/p0 matters (src/README.md, reading rules).
#include "flight/scenario/sweep.h"

#define VISITED_NEAR_M 0.02
#define VISITED_FAR_M  0.10

static done_t learn(const setup_t *setup, const rls_param_t *p, const training_t *x, int n, rls_t *rls,
                    why_t *why) {
  if (rls_init(rls, p, &setup->learn_from) != ST_OK)
    return error_set(why, "rls.lambda, rls.p0: out of range");
  for (int i = 0; i < n; i++) {
    float basis[RBF_N];
    rbf_basis((float)x[i].zc_m, basis);
    if (rls_update(rls, p, basis, (float)x[i].y) != ST_OK)
      return error_set(why, "a sample could not be learned");
  }
  return DONE;
}

static void tell(const rls_param_t *p, const rls_t *rls, const model_t *model, result_t *result) {
  const misfit_t m = training_misfit(&rls->theta, model, VISITED_NEAR_M, VISITED_FAR_M);
  cJSON *row = result_add_row(result, "fits");
  cJSON_AddNumberToObject(row, "lambda", (double)p->lambda);
  cJSON_AddNumberToObject(row, "p0", (double)p->p0);
  cJSON_AddNumberToObject(row, "rms", m.rms);
  cJSON_AddNumberToObject(row, "max", m.max);
  cJSON_AddNumberToObject(row, "at_1cm", m.at_1cm);
  cJSON_AddNumberToObject(row, "peak_m", m.peak_m);
  sweep_add_weights(row, &rls->theta);
}

static done_t learn_all(const setup_t *setup, const training_t *x, int n, result_t *result, why_t *why) {
  static const struct {
    float lambda, p0;
  } pairs[] = {{0.01f, 1}, {0.1f, 1}, {0.5f, 1}, {1, 1}, {1, 0.1f}, {0.5f, 5}, {0.5f, 25}};
  for (unsigned i = 0; i < sizeof pairs / sizeof *pairs; i++) {
    rls_param_t p = setup->flight.learn.rls;
    p.lambda = pairs[i].lambda;
    p.p0 = pairs[i].p0;
    rls_t rls;
    TRY(learn(setup, &p, x, n, &rls, why));
    tell(&p, &rls, &setup->model, result);
  }
  return DONE;
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(sweep_setup(&setup, request, why));
  return sweep_fly(&setup, VISITED_FAR_M, learn_all, result, why);
}

const scenario_t scenario_rls_sweep = {
    .name = "rls-sweep",
    .brief = "one learning flight, learned with seven pairs of lambda and p0 (thesis B.11-B.20)",
    .run = run,
};
