// scenario.c - scenarios by name, and the set-up that most of them share.
#include "scenario/scenario.h"

#include "io/model_file.h"
#include <string.h>

const scenario_t *scenario_find(const char *name) {
  for (int i = 0; i < scenario_count; i++)
    if (strcmp(scenario_table[i]->name, name) == 0) return scenario_table[i];
  return NULL;
}

status_t scenario_appendix_a_setup(setup_t *setup, fly_kind_t kind, why_t *why) {
  *setup = (setup_t){
      .kind = kind,
      .period_s = 0.01,
      .learn_from = {{1.0f}},
      .plan = {.way = {{0.0, 0.40}, {10.0, 0.43}, {20.0, 0.48}}, .n_way = 3, .end_s = 40.0},
      // Section 4.2's gains for 0.45 m with feed-forward, scaled to the mass.
      .pid = {.p = 0.032, .d = 0.128, .n_per_s = 100.0, .limit_N = 0.64, .ratio_max = 1.6},
  };
  params_default(&setup->flight);
  setup->flight.pos.thrust_max_N = 0.6f;
  setup->flight.curve.clip = 0;
  setup->flight.gap_min_m = 0.0f;
  setup->flight.learn.rls = (rls_param_t){.form = RLS_THESIS, .lambda = 0.5f, .p0 = 1.0f};
  return model_builtin("thesis_1d", &setup->model, why);
}
