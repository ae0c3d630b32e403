// setup.c - everything that one flight needs.
#include "flight/setup.h"

#include "pilots/param_spec.h"
#include "pilots/pilot.h"
#include "plant/vertical.h"
#include <math.h>
#include <stdlib.h>

const char *const fly_name[FLY_COUNT] = {
    [FLY_INDI] = "indi",
    [FLY_INDI_THEORY] = "indi-theory",
    [FLY_INDI_RBF] = "indi-rbf",
    [FLY_INDI_LEARNED] = "indi-learned",
    [FLY_PID] = "pid",
    [FLY_PID_FF] = "pid-ff",
    [FLY_STOCK_PID] = "stock-pid",
    [FLY_STOCK_INDI] = "stock-indi",
    [FLY_AIR_GARAGE] = "air-garage",
};

static const curve_mode_t mode_of[FLY_COUNT] = {
    [FLY_INDI] = CURVE_OFF,           [FLY_INDI_THEORY] = CURVE_THEORY, [FLY_INDI_RBF] = CURVE_FIXED,
    [FLY_INDI_LEARNED] = CURVE_FIXED, [FLY_INDI_LIVE] = CURVE_LIVE,
};

static bool has_surface(const model_t *model) {
  for (int i = 0; i < model->n_fx; i++)
    if (model->fx[i].fx->surface) return true;
  return false;
}

// The vehicle's numbers; the surroundings stay the scenario's where the file does not name any. Effects that
// the vehicle brings along wherever it flies (drag) are no surroundings.
static void take_vehicle(model_t *model, const model_t *vehicle) {
  const model_t scenario = *model;
  *model = *vehicle;
  if (!isfinite(vehicle->ceiling_m)) model->ceiling_m = scenario.ceiling_m;
  if (vehicle->floor_rise_x == 0.0 && vehicle->floor_rise_y == 0.0) {
    model->floor_rise_x = scenario.floor_rise_x;
    model->floor_rise_y = scenario.floor_rise_y;
  }
  if (has_surface(vehicle)) return;
  for (int i = 0; i < scenario.n_fx && model->n_fx < FX_MAX; i++)
    if (scenario.fx[i].fx->surface) model->fx[model->n_fx++] = scenario.fx[i];
}

done_t request_apply(const request_t *request, model_t *model, flight_param_t *flight,
                     rbf_weights_t *learn_from, fly_kind_t *kind, why_t *why) {
  if (request->kind) *kind = *request->kind;
  flight->curve.mode = (int32_t)mode_of[*kind];
  if (request->vehicle) take_vehicle(model, request->vehicle);
  if (request->no_effects) model->n_fx = 0;
  for (int i = 0; i < request->n_effect; i++) TRY(model_add_fx(model, &request->effect[i], why));
  for (int i = 0; i < request->n_set; i++) {
    const param_row_t *row = request->set[i].row;
    if (!row) continue; // the app's
    if (params_set(flight, row, request->set[i].value) != ST_OK)
      return error_set(why, "--set %s: allowed is %g to %g", row->name, (double)row->min, (double)row->max);
    // A weight that is set is also where learning starts.
    const ptrdiff_t weight = ((ptrdiff_t)row->offset - (ptrdiff_t)offsetof(flight_param_t, curve.fixed)) / 4;
    if (weight >= 0 && weight < RBF_N) learn_from->w[weight] = request->set[i].value;
  }
  return param_check_all(flight, why);
}

// On the vertical axis only what multiplies the thrust can act, and only what flies there can fly.
static done_t check_vertical(const setup_t *setup, int n_set, why_t *why) {
  if (setup->kind > FLY_PID_FF)
    return error_set(why, "--controller %s: this scenario is flown on the vertical axis, by indi* or pid*",
                     fly_name[setup->kind]);
  if (n_set > 0 && setup->kind >= FLY_PID)
    return error_set(why, "--set: those are parameters of the flight code, and %s flies; allowed with indi*",
                     fly_name[setup->kind]);
  for (int i = 0; i < setup->model.n_fx; i++)
    if (!setup->model.fx[i].fx->excess)
      return error_set(why, "--effect %s: this scenario is flown on the vertical axis, where it does not act",
                       setup->model.fx[i].fx->name);
  return DONE;
}

done_t setup_apply(setup_t *setup, const request_t *request, why_t *why) {
  TRY(request_apply(request, &setup->model, &setup->flight, &setup->learn_from, &setup->kind, why));
  TRY(check_vertical(setup, request->n_set, why));
  for (int i = 0; i < request->n_set; i++)
    if (request->set[i].app)
      return error_set(why, "--set %s: this scenario is flown on the vertical axis, where there is no app",
                       request->set[i].app->name);
  if (request->noise6)
    return error_set(why,
                     "--noise %s: this scenario is flown on the vertical axis; allowed are none, n1, n2, n3",
                     request->noise6->name);
  if (request->log_500_Hz || request->log_calls)
    return error_set(why, "--log-rate %d: this scenario is flown on the vertical axis; allowed is 100",
                     request->log_calls ? 1000 : 500);
  if (request->noise) setup->plan.noise = *request->noise;
  setup->plan.seed = request->seed;
  setup->plan.integrate = request->integrate;
  return DONE;
}

void setup_learning_ladder(plan_t *plan, double ceiling_m) {
  static const double gap_m[] = {0.20, 0.10, 0.08, 0.06, 0.04, 0.02};
  plan->n_way = (int)(sizeof gap_m / sizeof *gap_m);
  for (int i = 0; i < plan->n_way; i++) plan->way[i] = (waypoint_t){10.0 * i, ceiling_m - gap_m[i]};
  plan->end_s = 10.0 * plan->n_way;
  plan->start_z_m = plan->start_thrust_N = 0.0;
}

done_t setup_keep_params(fly_kind_t kind, const flight_param_t *flies, flown_t *flown, why_t *why) {
  flight_param_t *const shipped = &flown->shipped;
  params_default(shipped);
  shipped->curve.mode = (int32_t)mode_of[kind];
  if (kind == FLY_INDI_LIVE) shipped->curve.fixed = (rbf_weights_t){{1.0f}};
  if (kind == FLY_INDI_LEARNED) shipped->curve.fixed = flies->curve.fixed;
  flown->record.param = malloc((size_t)params_count * sizeof(float));
  if (!flown->record.param) return error_failed(why, "out of memory");
  for (int i = 0; i < params_count; i++) flown->record.param[i] = params_get(flies, &params_table[i]);
  return DONE;
}

static done_t fly_indi(const setup_t *setup, flown_t *flown, why_t *why) {
  pilot_t pilot;
  flight_param_t param = setup->flight;
  const bool live = param.curve.mode == CURVE_LIVE;
  if (live) param.curve.fixed = setup->learn_from;
  if (pilot_init(&pilot, &param, setup->period_s) != DONE)
    return error_set(why, "--set indiPos.cutoff: allowed is 0, or 0.1 to 45 Hz");
  const controller_t controller = pilot_controller(&pilot);
  TRY(loop_fly(&setup->plan, &setup->model, &controller, &flown->record, &flown->outcome, why));
  TRY(setup_keep_params(setup->kind, &pilot.flight.param, flown, why));
  flown->weights = live ? pilot.flight.learn.rls.theta : param.curve.fixed;
  return DONE;
}

// The thesis's third controller: a learning flight first, then its weights frozen.
static done_t learn_first(setup_t *setup, why_t *why) {
  if (!isfinite(setup->model.ceiling_m))
    return error_set(why, "--controller indi-learned: the vehicle file has no ceiling_m to learn from");
  setup_t learning = *setup;
  learning.flight.curve.mode = CURVE_LIVE;
  learning.plan.noise = noise_levels[1];
  setup_learning_ladder(&learning.plan, learning.model.ceiling_m);
  flown_t flight = {.n_segment = 0};
  const done_t status = fly_indi(&learning, &flight, why);
  setup->flight.curve.fixed = flight.weights;
  flown_free(&flight);
  return status;
}

static done_t fly_pid(const setup_t *setup, flown_t *flown, why_t *why) {
  pid_param_t param = setup->pid;
  param.feed_forward = setup->kind == FLY_PID_FF;
  param.hover_N = setup->model.mass_kg * PLANT_GRAVITY_MPS2;
  param.ceiling_m = setup->model.ceiling_m;
  param.radius_m = setup->model.rotor_radius_m;
  pid_peer_t pid;
  const controller_t controller = pid_controller(&pid, &param, setup->period_s);
  return loop_fly(&setup->plan, &setup->model, &controller, &flown->record, &flown->outcome, why);
}

done_t setup_fly(const setup_t *setup, flown_t *flown, why_t *why) {
  setup_t ready = *setup;
  *flown = (flown_t){.plan = setup->plan};
  if (setup->kind == FLY_INDI_LEARNED) TRY(learn_first(&ready, why));
  const bool pid = setup->kind == FLY_PID || setup->kind == FLY_PID_FF;
  const done_t status = pid ? fly_pid(&ready, flown, why) : fly_indi(&ready, flown, why);
  if (status != DONE) {
    flown_free(flown);
    return status;
  }
  flown->n_segment = segments_of(&flown->record, &flown->plan, flown->segment);
  return DONE;
}

void flown_free(flown_t *flown) {
  record_free(&flown->record);
}
