// channel.c - between a floor and a ceiling 15 cm above it, by motion capture, because a flow deck sees no
// flow so low. The first flight, over the floor alone at 20 to 1.5 cm, learns the floor's curve from nothing.
// Two flights in the channel learn the ceiling's curve from nothing: one without the floor's curve, which
// learns the floor's effect as the ceiling's, and one with it. The result has each learned curve beside the
// true effect of that surface. The floor's effect is what recorded flights of a Crazyflie show
// (sim/gap/README.md).
#include "flight/scenario.h"

#include <stdio.h>

#define CHANNEL_M 0.15
#define OPEN_M    2.0 // ceiling over the floor alone: neither felt nor seen
#define HOLD_S    10.0

static const double floor_m[] = {0.2, 0.1, 0.06, 0.03, 0.015}, gap_m[] = {0.06, 0.08, 0.05, 0.03, 0.02};
#define STEPS (int)(sizeof gap_m / sizeof *gap_m)

static done_t add_floor(model_t *model, why_t *why) {
  fx_use_t ground = fx_use(fx_find("ground"));
  ground.p[0] = 0.504; // Ca
  ground.p[1] = 0.763; // Cb
  ground.p[2] = 0.0;   // each: one distance for all rotors, for the fountain under the vehicle
  return model_add_fx(model, &ground, why);
}

static void tell(result_t *result, const char *flight, const char *surface, double at_m,
                 const rbf_weights_t *learned, double there) {
  cJSON *const row = result_add_row(result, "learned");
  cJSON_AddStringToObject(row, "flight", flight);
  cJSON_AddStringToObject(row, "surface", surface);
  cJSON_AddNumberToObject(row, "distance_mm", 1e3 * at_m);
  cJSON_AddNumberToObject(row, "excess", (double)rbf_at(learned, (float)at_m).ratio - 1.0);
  cJSON_AddNumberToObject(row, "there", there - 1.0);
}

static void tell_floor(const model_t *model, const rbf_weights_t *learned, result_t *result) {
  for (int i = 1; i < STEPS; i++) {
    const fx_place_t place = {HUGE_VAL, model->frame.rotor_above_feet_m + floor_m[i], model->rotor_radius_m};
    tell(result, "floor", "floor", floor_m[i], learned, model_thrust_ratio(model, &place));
  }
}

static void tell_ceiling(const model_t *model, const char *flight, const rbf_weights_t *learned,
                         result_t *result) {
  for (int i = 1; i < STEPS; i++) {
    const fx_place_t place = {gap_m[i], HUGE_VAL, model->rotor_radius_m};
    tell(result, flight, "ceiling", gap_m[i], learned, model_thrust_ratio(model, &place));
  }
}

static done_t fly(const setup_t *setup, const char *flight, flown_t *flown, why_t *why) {
  TRY(setup_fly(setup, flown, why));
  for (int i = 0; i < flown->n_segment; i++)
    snprintf(flown->segment[i].label, sizeof flown->segment[i].label, "%s", flight);
  return DONE;
}

static done_t learn_floor(setup_t setup, rbf_weights_t *learned, result_t *result, why_t *why) {
  double below_m[STEPS];
  setup.model.ceiling_m = OPEN_M;
  for (int i = 0; i < STEPS; i++) below_m[i] = OPEN_M - setup.model.frame.rotor_above_feet_m - floor_m[i];
  setup_ladder(&setup, below_m, STEPS, HOLD_S);
  setup.flight.ground.mode = CURVE_LIVE;
  flown_t flown;
  TRY(fly(&setup, "floor", &flown, why));
  *learned = flown.ground_weights;
  tell_floor(&setup.model, learned, result);
  result_add_flight(result, &flown);
  return DONE;
}

static done_t fly_channel(setup_t setup, const char *flight, curve_mode_t floor, const rbf_weights_t *learned,
                          result_t *result, why_t *why) {
  setup_ladder(&setup, gap_m, STEPS, HOLD_S);
  setup.flight.ground.mode = (int32_t)floor;
  setup.flight.ground.fixed = *learned;
  setup.floor_learned = true;
  flown_t flown;
  TRY(fly(&setup, flight, &flown, why));
  tell_ceiling(&setup.model, flight, &flown.weights, result);
  result_add_flight(result, &flown);
  return DONE;
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  rbf_weights_t learned;
  TRY(setup_thesis(&setup, FLY_INDI_LIVE, why));
  setup.model.ceiling_m = CHANNEL_M;
  TRY(add_floor(&setup.model, why));
  setup.plan.mocap = (mocap_param_t){.period_s = 0.01, .late_s = 0.005, .sd_m = 3e-4, .sd_rad = 1e-3};
  setup.flight.gap_min_m = 0.01f;
  setup.flight.guard.blind_max_s = SETUP_BLIND_S;
  TRY(setup_apply(&setup, request, why));
  TRY(scenario_check_learns(&setup, "channel", why));
  if (setup.model.ceiling_m != CHANNEL_M)
    return error_set(why, "--vehicle: ceiling_m is %g m; allowed in channel is none, or %g",
                     setup.model.ceiling_m, CHANNEL_M);
  TRY(learn_floor(setup, &learned, result, why));
  TRY(fly_channel(setup, "unknown", CURVE_OFF, &learned, result, why));
  return fly_channel(setup, "known", CURVE_FIXED, &learned, result, why);
}

const scenario_t scenario_channel = {
    .name = "channel",
    .brief =
        "six degrees of freedom, motion capture: between a floor and a ceiling 15 cm above it, learning the "
        "curves of both",
    .run = run,
};
