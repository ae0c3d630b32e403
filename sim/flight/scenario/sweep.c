// sweep.c - learning from one flight in several ways.
#include "flight/scenario/sweep.h"

#include <stdlib.h>

done_t sweep_setup(setup_t *setup, const request_t *request, why_t *why) {
  TRY(scenario_learning_setup(setup, request, why));
  if (setup->kind == FLY_PID || setup->kind == FLY_PID_FF)
    return error_set(why, "--controller %s: knows no ceiling distance to learn from", fly_name[setup->kind]);
  return DONE;
}

static done_t learn_from(const setup_t *setup, const record_t *record, double far_m, sweep_learn_fn *learn,
                         result_t *result, why_t *why) {
  training_t *training = calloc((size_t)record->n, sizeof *training);
  if (!training) return error_failed(why, "out of memory");
  const int n = training_of(record, setup, far_m, training);
  const done_t status = learn(setup, training, n, result, why);
  free(training);
  return status;
}

done_t sweep_fly(const setup_t *setup, double far_m, sweep_learn_fn *learn, result_t *result, why_t *why) {
  flown_t flown;
  TRY(setup_fly(setup, &flown, why));
  const done_t status = learn_from(setup, &flown.record, far_m, learn, result, why);
  result_add_flight(result, &flown);
  flown_free(&flown);
  return status;
}

void sweep_add_weights(cJSON *row, const rbf_weights_t *w) {
  for (int i = 0; i < RBF_N; i++) {
    char name[24];
    snprintf(name, sizeof name, "w%d", i + 1);
    cJSON_AddNumberToObject(row, name, (double)w->w[i]);
  }
}
