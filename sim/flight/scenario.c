// scenario.c - scenarios by name, and the set-up that most of them share.
#include "flight/scenario.h"

#include "base/nearest.h"
#include "base/number.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <string.h>

#define LADDER_FROM_M 0.25 // the ladder begins 20 cm below the ceiling

const scenario_t *scenario_find(const char *name) {
  for (int i = 0; i < scenario_count; i++)
    if (strcmp(scenario_table[i]->name, name) == 0) return scenario_table[i];
  return NULL;
}

done_t scenario_take(const char *name, const scenario_t **scenario, why_t *why) {
  char shown[NUMBER_SHOWN], hint[NEAREST_HINT];
  nearest_t nearest = nearest_to(name);
  *scenario = scenario_find(name);
  if (*scenario) return DONE;
  for (int i = 0; i < scenario_count; i++) nearest_try(&nearest, scenario_table[i]->name);
  return error_set(why, "%s: no such scenario%s; fly --list shows them", number_shown(name, shown),
                   nearest_hint(&nearest, hint));
}

done_t scenario_check_ladder(const model_t *model, why_t *why) {
  const double ceiling_m = model->ceiling_m;
  if (ceiling_m >= LADDER_FROM_M && ceiling_m <= 100.0) return DONE;
  return error_set(why, "--vehicle: ceiling_m is %g m; this scenario needs %g to 100 m", ceiling_m,
                   LADDER_FROM_M);
}

done_t scenario_check_learns(const setup_t *setup, const char *name, why_t *why) {
  if (setup->flight.curve.mode == CURVE_LIVE) return DONE;
  return error_set(why,
                   "--controller, --set ceil.mode: nothing learns then; allowed in %s are neither, and "
                   "ceil.mode=2",
                   name);
}

done_t scenario_appendix_a_setup(setup_t *setup, fly_kind_t kind, why_t *why) {
  *setup = (setup_t){
      .kind = kind,
      .learn_from = {{1.0f}},
      .plan = {.vertical_only = true,
               .period_s = 0.01,
               .way = {{0.0, 0.40}, {10.0, 0.43}, {20.0, 0.48}},
               .n_way = 3,
               .end_s = 40.0},
      // Table 4.2's gains for 0.40 m, scaled to the mass.
      .pid = {.p = 2.24, .i = 0.32, .d = 0.512, .n_per_s = 100.0, .limit_N = 0.64, .ratio_max = 1.6},
  };
  TRY(model_builtin("thesis_1d", &setup->model, why));
  // Appendix A's own numbers; `fly` prints them.
  params_default(&setup->flight);
  param_thesis(&setup->flight);
  setup->flight.pos.mass_kg = (float)setup->model.mass_kg;
  setup->flight.motor_tau_s = (float)setup->model.motor_tau_s;
  setup->flight.pos.thrust_max_N = 0.6f;
  setup->flight.curve.clip = 0;
  setup->flight.gap_min_m = 0.0f;
  setup->flight.bias.pole_radps = 0.0f; // the thesis has no bias observer
  setup->flight.learn.rls = (rls_param_t){.form = RLS_THESIS, .lambda = 0.5f, .p0 = 1.0f};
  return DONE;
}

done_t scenario_learning_setup(setup_t *setup, const request_t *request, why_t *why) {
  TRY(scenario_appendix_a_setup(setup, FLY_INDI_LIVE, why));
  setup->plan.vertical_noise = vertical_noise_levels[1];
  TRY(setup_apply(setup, request, why));
  TRY(scenario_check_ladder(&setup->model, why));
  setup_close_ladder(setup);
  return DONE;
}

done_t scenario_thesis_setup(setup_t *setup, fly_kind_t kind, const request_t *request, why_t *why) {
  TRY(setup_thesis(setup, kind, why));
  setup->flight.guard.blind_max_s = SETUP_BLIND_S;
  TRY(setup_apply(setup, request, why));
  return scenario_check_ladder(&setup->model, why);
}

done_t scenario_fly(const setup_t *setup, result_t *result, why_t *why) {
  flown_t flown;
  TRY(setup_fly(setup, &flown, why));
  result_add_flight(result, &flown);
  // Needed to interpret the distances.
  if (isfinite(setup->model.ceiling_m))
    cJSON_AddNumberToObject(result->json, "ceiling_m", setup->model.ceiling_m);
  cJSON_AddNumberToObject(result->json, "rotor_radius_m", setup->model.rotor_radius_m);
  return DONE;
}
