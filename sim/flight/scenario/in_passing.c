// in_passing.c - learning without a learning flight: 20 cm below the ceiling, 10 s at 3 cm, then 20 and 15
// mm, with a curve that is learned on the way and used at once. Three curves to start from: flat, and half
// and twice the excess of the fixed weights. What was learned at 3 cm has to serve nearer than that, too. So
// the result has the excess of the ratio over 1 at 3 cm and the slope at 15 mm, each beside the plant's.
#include "flight/params.h"
#include "flight/scenario.h"

#include <stdio.h>

#define LEARNED_M 0.03
#define NEAR_M    0.015
#define STEP_M    1e-4
#define HOLD_S    10.0

static const struct {
  const char *name;
  float share; // of the excess over 1
} START[] = {{"flat", 0.0f}, {"half", 0.5f}, {"double", 2.0f}};

static rbf_weights_t scaled(const rbf_weights_t *w, float share) {
  rbf_weights_t part;
  for (int i = 0; i < RBF_N; i++) part.w[i] = share * w->w[i];
  part.w[0] += 1.0f - share;
  return part;
}

// Returns the weights of the curve that was flown when the vehicle left 3 cm.
static rbf_weights_t learned_until(const record_t *r, double until_s) {
  rbf_weights_t w = {{1.0f}};
  for (int i = 0; i < r->n && r->sample[i].t_s < until_s; i++)
    for (int j = 0; j < RBF_N; j++) w.w[j] = (float)r->sample[i].thoughts.weights[j];
  return w;
}

static double ratio_there(const model_t *model, double zc_m) {
  const fx_place_t place = {zc_m, model->ceiling_m - zc_m, model->rotor_radius_m};
  return model_thrust_ratio(model, &place);
}

static void tell(const char *start, const rbf_weights_t *w, const model_t *model, result_t *result) {
  cJSON *row = result_add_row(result, "learned_at_3cm");
  cJSON_AddStringToObject(row, "start", start);
  cJSON_AddNumberToObject(row, "excess_3cm", (double)rbf_at(w, (float)LEARNED_M).ratio - 1.0);
  cJSON_AddNumberToObject(row, "there_3cm", ratio_there(model, LEARNED_M) - 1.0);
  cJSON_AddNumberToObject(row, "slope_15mm", (double)rbf_at(w, (float)NEAR_M).slope_per_m);
  const double rise = ratio_there(model, NEAR_M + STEP_M) - ratio_there(model, NEAR_M - STEP_M);
  cJSON_AddNumberToObject(row, "there_15mm", rise / (2.0 * STEP_M));
}

static done_t fly_from(setup_t setup, int start, result_t *result, why_t *why) {
  setup.learn_from = scaled(&setup.flight.curve.fixed, START[start].share);
  flown_t flown;
  flight_param_t ships;
  params_default(&ships);
  TRY(setup_fly(&setup, &flown, why));
  // The curve to start from does not count as a parameter that was set.
  flown.shipped.curve.fixed = scaled(&ships.curve.fixed, START[start].share);
  const rbf_weights_t w = learned_until(&flown.record, setup.plan.way[2].at_s);
  tell(START[start].name, &w, &setup.model, result);
  for (int i = 0; i < flown.n_segment; i++)
    snprintf(flown.segment[i].label, sizeof flown.segment[i].label, "%s", START[start].name);
  result_add_flight(result, &flown);
  return DONE;
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  static const double gap_m[] = {0.20, LEARNED_M, 0.020, NEAR_M};
  setup_t setup;
  TRY(setup_thesis(&setup, FLY_INDI_LIVE, why));
  setup.flight.gap_min_m = 0.01f;
  setup.flight.guard.blind_max_s = SETUP_BLIND_S;
  TRY(setup_apply(&setup, request, why));
  TRY(scenario_check_learns(&setup, "in-passing", why));
  TRY(scenario_check_ladder(&setup.model, why));
  setup_ladder(&setup, gap_m, (int)(sizeof gap_m / sizeof *gap_m), HOLD_S);
  for (int i = 0; i < (int)(sizeof START / sizeof *START); i++) TRY(fly_from(setup, i, result, why));
  cJSON_AddNumberToObject(result->json, "ceiling_m", setup.model.ceiling_m);
  return DONE;
}

const scenario_t scenario_in_passing = {
    .name = "in-passing",
    .brief = "six degrees of freedom, real sensors: 3 cm, 20 and 15 mm, learning the curve on the way from "
             "flat, half and double",
    .run = run,
};
