// setup.c - everything that one flight needs.
#include "flight/setup.h"

#include "base/constants.h"
#include "crazyflie/stock_indi.h"
#include "crazyflie/usd_deck.h"
#include "pilots/pilot_flight.h"
#include "pilots/pilot_outer.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CEILING_M   0.5
#define DECAY_PER_M 80.0 // of the thesis's ceiling effect
#define TAKE_OFF_S  1.0
#define HOVER_S     12.0 // at a ladder's first gap, take-off included

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

done_t setup_thesis(setup_t *setup, fly_kind_t kind, why_t *why) {
  *setup = (setup_t){.kind = kind,
                     .learn_from = {{1.0f}},
                     .stock_pid = stock_pid_default(),
                     .air_garage = air_garage_2024(),
                     .plan = {.noise = *noise_find("real")}};
  TRY(model_builtin("cf21_legacy", &setup->model, why));
  setup->model.ceiling_m = CEILING_M;
  fx_use_t ceiling = fx_use(fx_find("ceiling"));
  ceiling.p[1] = DECAY_PER_M * setup->model.rotor_radius_m;
  TRY(model_add_fx(&setup->model, &ceiling, why));
  params_default(&setup->flight); // what ships is what flies
  return DONE;
}

// --- what is asked for ------------------------------------------------------------------------------------

static bool has_surface(const model_t *model) {
  for (int i = 0; i < model->n_fx; i++)
    if (model->fx[i].fx->surface) return true;
  return false;
}

// Takes the vehicle's numbers. The surroundings stay the scenario's where the file does not name any; effects
// that the vehicle brings along wherever it flies (drag) do not belong to them.
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

static done_t take_request(setup_t *setup, const request_t *request, why_t *why) {
  flight_param_t *const flight = &setup->flight;
  if (request->kind) setup->kind = *request->kind;
  flight->curve.mode = (int32_t)mode_of[setup->kind];
  if (request->thesis_law) param_thesis(flight);
  if (request->no_effects) setup->model.n_fx = 0;
  if (request->vehicle) take_vehicle(&setup->model, request->vehicle);
  for (int i = 0; i < request->n_effect; i++) TRY(model_add_fx(&setup->model, &request->effect[i], why));
  for (int i = 0; i < request->n_set; i++) {
    const param_row_t *row = request->set[i].row;
    if (!row) continue; // of the app alone
    if (params_set(flight, row, request->set[i].value) != ST_OK)
      return error_set(why, "--set %s: allowed is %g to %g", row->name, (double)row->min, (double)row->max);
    // A weight that is set is also where learning starts.
    const ptrdiff_t weight = ((ptrdiff_t)row->offset - (ptrdiff_t)offsetof(flight_param_t, curve.fixed)) / 4;
    if (weight >= 0 && weight < RBF_N) setup->learn_from.w[weight] = request->set[i].value;
  }
  setup->plan.seed = request->seed;
  setup->plan.integrate = request->integrate;
  return param_check_all(flight, why);
}

// On the vertical axis only effects that multiply the thrust can act, and only indi* and pid* can fly.
static done_t take_vertical(setup_t *setup, const request_t *request, why_t *why) {
  if (setup->kind > FLY_PID_FF)
    return error_set(why, "--controller %s: this scenario is flown on the vertical axis, by indi* or pid*",
                     fly_name[setup->kind]);
  if (request->n_set > 0 && setup->kind >= FLY_PID)
    return error_set(why, "--set: those are parameters of the flight code, and %s flies; allowed with indi*",
                     fly_name[setup->kind]);
  if (request->thesis_law)
    return error_set(why, "--thesis-law: this scenario is flown on the vertical axis, by that law or a PID");
  for (int i = 0; i < setup->model.n_fx; i++)
    if (!setup->model.fx[i].fx->excess)
      return error_set(why, "--effect %s: this scenario is flown on the vertical axis, where it does not act",
                       setup->model.fx[i].fx->name);
  for (int i = 0; i < request->n_set; i++)
    if (request->set[i].app)
      return error_set(why, "--set %s: this scenario is flown on the vertical axis, where there is no app",
                       request->set[i].app->name);
  if (request->noise)
    return error_set(why,
                     "--noise %s: this scenario is flown on the vertical axis; allowed are none, n1, n2, n3",
                     request->noise->name);
  if (request->log_500_Hz || request->log_calls)
    return error_set(why, "--log-rate %d: this scenario is flown on the vertical axis; allowed is 100",
                     request->log_calls ? 1000 : 500);
  if (request->vertical_noise) setup->plan.vertical_noise = *request->vertical_noise;
  return DONE;
}

// The firmware is built for the propellers that it flies with, and knows two kinds.
static done_t take_propellers(setup_t *setup, why_t *why) {
  const stock_power_param_t known[] = {stock_power_legacy(), stock_power_plus()};
  const thrust_map_t *map = &setup->model.map;
  for (int k = 0; k < 2; k++) {
    double apart = map->kind == THRUST_MAP_VOLT_CUBIC ? 0.0 : HUGE_VAL;
    for (int i = 0; i < 4; i++) apart = fmax(apart, fabs(map->c[i] - known[k].volt_cubic[i]));
    if (apart > 1e-7) continue; // the precision of the vehicle files
    memcpy(setup->stock_pid.power.volt_cubic, known[k].volt_cubic, sizeof known[k].volt_cubic);
    memcpy(setup->air_garage.pid.power.volt_cubic, known[k].volt_cubic, sizeof known[k].volt_cubic);
    return DONE;
  }
  return error_set(
      why, "--controller %s: knows the thrust maps of cf21_legacy and cf21_plus alone, and not that of %s",
      fly_name[setup->kind], setup->model.name);
}

static done_t check_stock(setup_t *setup, const request_t *request, why_t *why) {
  if (setup->kind < FLY_STOCK_PID) return DONE;
  if (request->thesis_law)
    return error_set(why, "--thesis-law: %s flies; allowed with indi*", fly_name[setup->kind]);
  if (request->n_set > 0)
    return error_set(why, "--set: those are parameters of the flight code, and %s flies; allowed with indi*",
                     fly_name[setup->kind]);
  return take_propellers(setup, why);
}

static done_t take_six(setup_t *setup, const request_t *request, why_t *why) {
  if (setup->kind == FLY_PID || setup->kind == FLY_PID_FF)
    return error_set(why, "--controller %s: flies on the vertical axis only", fly_name[setup->kind]);
  TRY(check_stock(setup, request, why));
  if (request->vehicle && !setup->model.frame_told)
    return error_set(why,
                     "--vehicle: %s has no [body] and [rotors]; in six degrees of freedom both are needed",
                     setup->model.name);
  if (request->vertical_noise)
    return error_set(
        why, "--noise %s: this scenario is flown in six degrees of freedom; allowed are quiet, real, flown",
        request->vertical_noise->name);
  if (request->noise) setup->plan.noise = *request->noise;
  setup->plan.record_every = request->log_500_Hz ? 1 : 0;
  setup->request = request;
  return DONE;
}

done_t setup_apply(setup_t *setup, const request_t *request, why_t *why) {
  TRY(take_request(setup, request, why));
  return setup->plan.vertical_only ? take_vertical(setup, request, why) : take_six(setup, request, why);
}

// --- ladders ----------------------------------------------------------------------------------------------

void setup_ladder(setup_t *setup, const double *gap_m, int n, double hold_s) {
  plan_t *plan = &setup->plan;
  const double hover_s = plan->vertical_only ? hold_s : HOVER_S;
  plan->take_off_s = plan->vertical_only ? 0.0 : TAKE_OFF_S;
  plan->below_estimate = !plan->vertical_only;
  plan->start_z_m = plan->start_thrust_N = 0.0;
  plan->n_way = n;
  for (int i = 0; i < n; i++) {
    const double at_s = i == 0 ? 0.0 : hover_s + hold_s * (i - 1);
    plan->way[i] = (waypoint_t){at_s, setup->model.ceiling_m - gap_m[i]};
  }
  plan->end_s = hover_s + hold_s * (n - 1);
}

void setup_close_ladder(setup_t *setup) {
  static const double gap_m[] = {0.20, 0.10, 0.08, 0.06, 0.04, 0.02};
  setup_ladder(setup, gap_m, (int)(sizeof gap_m / sizeof *gap_m), 10.0);
}

// --- who flies --------------------------------------------------------------------------------------------

// Keeps the parameters that were flown, and those that ship with the controller: every default, but for the
// curve's mode, which the controller's name stands for, a flat curve (1 + 0) where it learns from nothing,
// and what it learned where it has learned.
static done_t keep_params(const setup_t *setup, const flight_param_t *flies, flown_t *flown, why_t *why) {
  const fly_kind_t kind = setup->kind;
  flight_param_t *const shipped = &flown->shipped;
  params_default(shipped);
  shipped->curve.mode = (int32_t)mode_of[kind];
  if (kind == FLY_INDI_LIVE) shipped->curve.fixed = (rbf_weights_t){{1.0f}};
  if (kind == FLY_INDI_LEARNED) shipped->curve.fixed = flies->curve.fixed;
  if (setup->floor_learned) shipped->ground.fixed = flies->ground.fixed;
  flown->record.param = malloc((size_t)params_count * sizeof(float));
  if (!flown->record.param) return error_failed(why, "out of memory");
  for (int i = 0; i < params_count; i++) flown->record.param[i] = params_get(flies, &params_table[i]);
  return DONE;
}

// Sets what only the app has: its own parameters, the uSD deck and its logs.
static void prepare_app(pilot_flight_t *p, const request_t *request) {
  if (!request) return;
  for (int i = 0; i < request->n_set; i++)
    if (request->set[i].app)
      (void)crazyflie_set(&p->vehicle, request->set[i].app->name, (double)request->set[i].value);
  if (request->usd) usd_deck_start(request->usd, &p->vehicle);
  p->log_every_ms = !request->log ? 0 : request->log_calls ? 1 : request->log_500_Hz ? 2 : 10;
}

static done_t fly_outer(const setup_t *setup, const flight_param_t *param, flown_t *flown, why_t *why) {
  pilot_outer_t p;
  pilot_t pilot;
  plan_t plan = setup->plan;
  plan.period_s = (double)(float)plan.period_s; // single precision, as in the flight code
  if (pilot_outer_init(&p, param, plan.period_s, &pilot) != DONE)
    return error_set(why, "--set indiPos.cutoff: allowed is 0, or 0.1 to 45 Hz");
  TRY(loop_fly(&plan, &setup->model, &pilot, &flown->record, &flown->outcome, why));
  flown->weights = p.flight.learn.rls.theta;
  return keep_params(setup, &p.flight.param, flown, why);
}

static done_t fly_app(const setup_t *setup, const flight_param_t *param, flown_t *flown, why_t *why) {
  pilot_flight_t p;
  pilot_t pilot;
  if (pilot_flight_init(&p, param, &setup->model, &pilot) != DONE)
    return error_set(why, "--set: indiPos.cutoff is 0 or 0.1 to 45 Hz, indiAtt.cutoff 0 or 0.5 to 200 Hz");
  prepare_app(&p, setup->request);
  const done_t status = loop_fly(&setup->plan, &setup->model, &pilot, &flown->record, &flown->outcome, why);
  flown->record.app = p.log;
  if (p.log_every_ms == 1) flown->record.n_calls = p.n_log;
  TRY(status);
  if (setup->request && setup->request->log && p.n_log < flown->record.n)
    return error_failed(why, "out of memory");
  flown->weights = p.flight->outer.learn.rls.theta;
  flown->ground_weights = p.flight->ground.learn.rls.theta;
  return keep_params(setup, &p.flight->outer.param, flown, why); // as the app has them
}

static done_t fly_indi(const setup_t *setup, flown_t *flown, why_t *why) {
  flight_param_t param = setup->flight;
  const bool live = param.curve.mode == CURVE_LIVE;
  if (live) param.curve.fixed = setup->learn_from;
  TRY(setup->plan.vertical_only ? fly_outer(setup, &param, flown, why) : fly_app(setup, &param, flown, why));
  if (!live) flown->weights = param.curve.fixed;
  return DONE;
}

static pilot_t air_garage_knowing(const setup_t *setup, air_garage_t *s) {
  air_garage_param_t p = setup->air_garage;
  const double rotor_m = setup->model.frame.rotor_above_feet_m;
  if (!isfinite(p.ceiling_m)) {
    p.ceiling_m = setup->model.ceiling_m - rotor_m;
    p.ground_m = -rotor_m;
  }
  return air_garage_pilot(s, &p);
}

static done_t fly_stock(const setup_t *setup, flown_t *flown, why_t *why) {
  stock_pid_t pid;
  stock_indi_t indi;
  air_garage_t garage;
  stock_indi_param_t indi_param = stock_indi_default();
  memcpy(indi_param.power.volt_cubic, setup->stock_pid.power.volt_cubic, sizeof indi_param.power.volt_cubic);
  const pilot_t pilot = setup->kind == FLY_STOCK_PID    ? stock_pid_pilot(&pid, &setup->stock_pid)
                        : setup->kind == FLY_STOCK_INDI ? stock_indi_pilot(&indi, &indi_param)
                                                        : air_garage_knowing(setup, &garage);
  return loop_fly(&setup->plan, &setup->model, &pilot, &flown->record, &flown->outcome, why);
}

static done_t fly_pid(const setup_t *setup, flown_t *flown, why_t *why) {
  pid_param_t param = setup->pid;
  param.feed_forward = setup->kind == FLY_PID_FF;
  param.hover_N = setup->model.mass_kg * G_MPS2;
  param.ceiling_m = setup->model.ceiling_m;
  param.radius_m = setup->model.rotor_radius_m;
  pid_peer_t pid;
  const pilot_t pilot = pid_pilot(&pid, &param, setup->plan.period_s);
  return loop_fly(&setup->plan, &setup->model, &pilot, &flown->record, &flown->outcome, why);
}

// Flies the learning flight of thesis section 5.3 and freezes its weights.
static done_t learn_first(setup_t *setup, why_t *why) {
  if (!isfinite(setup->model.ceiling_m))
    return error_set(why, "--controller indi-learned: there is no ceiling here to learn from");
  setup_t learning = *setup;
  learning.flight.curve.mode = CURVE_LIVE;
  learning.plan.vertical_noise = vertical_noise_levels[1];
  setup_close_ladder(&learning);
  request_t unseen = setup->request ? *setup->request : (request_t){.seed = 0};
  unseen.usd = NULL; // the deck writes the flight that is asked for
  if (setup->request) learning.request = &unseen;
  flown_t flight = {.n_segment = 0};
  const done_t status = fly_indi(&learning, &flight, why);
  setup->flight.curve.fixed = flight.weights;
  flown_free(&flight);
  return status;
}

done_t setup_fly(const setup_t *setup, flown_t *flown, why_t *why) {
  setup_t ready = *setup;
  *flown = (flown_t){.plan = setup->plan};
  if (setup->kind == FLY_INDI_LEARNED) TRY(learn_first(&ready, why));
  const bool pid = setup->kind == FLY_PID || setup->kind == FLY_PID_FF, stock = setup->kind >= FLY_STOCK_PID;
  const done_t status = pid     ? fly_pid(&ready, flown, why)
                        : stock ? fly_stock(&ready, flown, why)
                                : fly_indi(&ready, flown, why);
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
