// setup6.c - everything that one flight in six degrees of freedom needs.
#include "flight/setup6.h"

#include "crazyflie/stock_indi.h"
#include "crazyflie/usd_deck.h"
#include "pilots/air_garage.h"
#include "pilots/pilot_flight.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CEILING_M   0.5
#define DECAY_PER_M 80.0 // of the thesis's ceiling effect

done_t setup6_thesis(setup6_t *setup, fly_kind_t kind, why_t *why) {
  *setup = (setup6_t){.kind = kind,
                      .learn_from = {{1.0f}},
                      .stock_pid = stock_pid_default(),
                      .air_garage = air_garage_2024(),
                      .plan = {.noise = *noise6_find("real")}};
  TRY(model_builtin("cf21_legacy", &setup->model, why));
  setup->model.ceiling_m = CEILING_M;
  fx_use_t ceiling = fx_use(fx_find("ceiling"));
  ceiling.p[1] = DECAY_PER_M * setup->model.rotor_radius_m;
  TRY(model_add_fx(&setup->model, &ceiling, why));
  params_default(&setup->flight); // what ships is what flies
  return DONE;
}

// The firmware is built for the propellers that it flies with, and knows two kinds.
static done_t take_propellers(setup6_t *setup, why_t *why) {
  const stock_power_param_t known[] = {stock_power_legacy(), stock_power_plus()};
  const thrust_map_t *map = &setup->model.map;
  for (int k = 0; k < 2; k++) {
    double apart = map->kind == THRUST_MAP_VOLT_CUBIC ? 0.0 : HUGE_VAL;
    for (int i = 0; i < 4; i++) apart = fmax(apart, fabs(map->c[i] - known[k].volt_cubic[i]));
    if (apart > 1e-7) continue; // the digits of the vehicle files
    memcpy(setup->stock_pid.power.volt_cubic, known[k].volt_cubic, sizeof known[k].volt_cubic);
    memcpy(setup->air_garage.pid.power.volt_cubic, known[k].volt_cubic, sizeof known[k].volt_cubic);
    return DONE;
  }
  return error_set(
      why, "--controller %s: knows the thrust maps of cf21_legacy and cf21_plus alone, and not that of %s",
      fly_name[setup->kind], setup->model.name);
}

static done_t check_stock(setup6_t *setup, const request_t *request, why_t *why) {
  if (setup->kind < FLY_STOCK_PID) return DONE;
  if (request->n_set > 0)
    return error_set(why, "--set: those are parameters of the flight code, and %s flies; allowed with indi*",
                     fly_name[setup->kind]);
  return take_propellers(setup, why);
}

done_t setup6_apply(setup6_t *setup, const request_t *request, why_t *why) {
  TRY(request_apply(request, &setup->model, &setup->flight, &setup->learn_from, &setup->kind, why));
  if (setup->kind == FLY_PID || setup->kind == FLY_PID_FF)
    return error_set(why, "--controller %s: flies on the vertical axis only", fly_name[setup->kind]);
  TRY(check_stock(setup, request, why));
  if (request->vehicle && !setup->model.frame_told)
    return error_set(why,
                     "--vehicle: %s has no [body] and [rotors]; in six degrees of freedom both are needed",
                     setup->model.name);
  if (request->noise)
    return error_set(why,
                     "--noise %s: this scenario is flown in six degrees of freedom; allowed are quiet, real",
                     request->noise->name);
  if (request->noise6) setup->plan.noise = *request->noise6;
  setup->plan.record_every = request->log_500_Hz ? 1 : 0;
  setup->plan.plan.seed = request->seed;
  setup->plan.plan.integrate = request->integrate;
  setup->request = request;
  return DONE;
}

void setup6_ladder(setup6_t *setup, const double *gap_m, int n, double hold_s) {
  plan_t *plan = &setup->plan.plan;
  const double hover_s = 12.0; // at the first gap, take-off included
  setup->plan.take_off_s = 1.0;
  setup->plan.below_estimate = true;
  plan->n_way = n;
  for (int i = 0; i < n; i++) {
    const double at_s = i == 0 ? 0.0 : hover_s + hold_s * (i - 1);
    plan->way[i] = (waypoint_t){at_s, setup->model.ceiling_m - gap_m[i]};
  }
  plan->end_s = hover_s + hold_s * (n - 1);
}

void setup6_close_ladder(setup6_t *setup) {
  static const double gap_m[] = {0.20, 0.10, 0.08, 0.06, 0.04, 0.02};
  setup6_ladder(setup, gap_m, (int)(sizeof gap_m / sizeof *gap_m), 10.0);
}

static void ask_flight(const void *state, thoughts_t *thoughts) {
  const pilot_flight_t *p = state;
  const outer_out_t *out = &p->flight->out.outer;
  thoughts->zc_m = out->zc_known ? (double)out->zc_m : (double)NAN;
  thoughts->ceiling_z_m = (double)out->ceiling_z_m;
  thoughts->ratio = (double)out->at.ratio;
  thoughts->slope_per_m = (double)out->at.slope_per_m;
  thoughts->guard_now = p->flight->guard.now;
  thoughts->guard_latched = p->flight->guard.latched;
  for (int i = 0; i < RBF_N; i++) {
    thoughts->weights[i] = (double)p->flight->outer.learn.rls.theta.w[i];
    thoughts->variance[i] = (double)p->flight->outer.learn.rls.P[i][i];
  }
}

// What only the app knows.
static void take_request(pilot_flight_t *p, const request_t *request) {
  if (!request) return;
  for (int i = 0; i < request->n_set; i++)
    if (request->set[i].app)
      (void)crazyflie_set(&p->vehicle, request->set[i].app->name, (double)request->set[i].value);
  if (request->usd) usd_deck_start(request->usd, &p->vehicle);
  p->log_every_ms = !request->log ? 0 : request->log_calls ? 1 : request->log_500_Hz ? 2 : 10;
}

static done_t fly_flight(const setup6_t *setup, flown6_t *flown, why_t *why) {
  flight_param_t param = setup->flight;
  const bool live = param.curve.mode == CURVE_LIVE;
  if (live) param.curve.fixed = setup->learn_from;
  pilot_flight_t p;
  pilot6_t pilot;
  const done_t opened = pilot_flight_init(&p, &param, &setup->model, &pilot);
  if (opened != DONE)
    return error_set(why, "--set: indiPos.cutoff is 0 or 0.1 to 45 Hz, indiAtt.cutoff 0 or 0.5 to 200 Hz");
  take_request(&p, setup->request);
  const done_t status = loop6_fly(&setup->plan, &setup->model, &pilot, ask_flight, &flown->flown.record,
                                  &flown->more, &flown->flown.outcome, why);
  flown->flown.record.app = p.log;
  if (p.log_every_ms == 1) flown->flown.record.n_calls = p.n_log;
  TRY(status);
  TRY(setup_keep_params(setup->kind, &p.flight->outer.param, &flown->flown, why)); // the app's own
  if (setup->request && setup->request->log && p.n_log < flown->flown.record.n)
    return error_failed(why, "out of memory");
  flown->flown.weights = live ? p.flight->outer.learn.rls.theta : param.curve.fixed;
  return DONE;
}

static pilot6_t air_garage_knowing(const setup6_t *setup, air_garage_t *s) {
  air_garage_param_t p = setup->air_garage;
  const double rotor_m = setup->model.frame.rotor_above_feet_m;
  if (!isfinite(p.ceiling_m)) {
    p.ceiling_m = setup->model.ceiling_m - rotor_m;
    p.ground_m = -rotor_m;
  }
  return air_garage_pilot(s, &p);
}

static done_t fly_stock(const setup6_t *setup, flown6_t *flown, why_t *why) {
  stock_pid_t pid;
  stock_indi_t indi;
  air_garage_t garage;
  stock_indi_param_t indi_param = stock_indi_default();
  memcpy(indi_param.power.volt_cubic, setup->stock_pid.power.volt_cubic, sizeof indi_param.power.volt_cubic);
  const pilot6_t pilot = setup->kind == FLY_STOCK_PID    ? stock_pid_pilot(&pid, &setup->stock_pid)
                         : setup->kind == FLY_STOCK_INDI ? stock_indi_pilot(&indi, &indi_param)
                                                         : air_garage_knowing(setup, &garage);
  return loop6_fly(&setup->plan, &setup->model, &pilot, NULL, &flown->flown.record, &flown->more,
                   &flown->flown.outcome, why);
}

// The learning flight of thesis section 5.3, and its weights frozen.
static done_t learn_first(setup6_t *setup, why_t *why) {
  if (!isfinite(setup->model.ceiling_m))
    return error_set(why, "--controller indi-learned: there is no ceiling here to learn from");
  setup6_t learning = *setup;
  learning.flight.curve.mode = CURVE_LIVE;
  setup6_close_ladder(&learning);
  request_t unseen = setup->request ? *setup->request : (request_t){.seed = 0};
  unseen.usd = NULL; // what is written is the flight that is asked for
  if (setup->request) learning.request = &unseen;
  flown6_t flight = {.more = {0}};
  const done_t status = fly_flight(&learning, &flight, why);
  setup->flight.curve.fixed = flight.flown.weights;
  flown6_free(&flight);
  return status;
}

static void measure_tilt(flown6_t *flown) {
  const plan_t *plan = &flown->flown.plan;
  int way = 0;
  for (int i = 0; i < flown->flown.record.n; i++) {
    while (way + 1 < plan->n_way && flown->flown.record.sample[i].t_s > plan->way[way + 1].at_s) way++;
    flown->tilt_max_rad[way] = fmax(flown->tilt_max_rad[way], flown->more.sample[i].tilt_rad);
  }
}

done_t setup6_fly(const setup6_t *setup, flown6_t *flown, why_t *why) {
  setup6_t ready = *setup;
  *flown = (flown6_t){.flown = {.plan = setup->plan.plan}};
  if (setup->kind == FLY_INDI_LEARNED) TRY(learn_first(&ready, why));
  const bool stock = setup->kind >= FLY_STOCK_PID;
  const done_t status = stock ? fly_stock(&ready, flown, why) : fly_flight(&ready, flown, why);
  if (status != DONE) {
    flown6_free(flown);
    return status;
  }
  flown->flown.n_segment = segments_of(&flown->flown.record, &flown->flown.plan, flown->flown.segment);
  measure_tilt(flown);
  return DONE;
}

void flown6_free(flown6_t *flown) {
  flown_free(&flown->flown);
  record6_free(&flown->more);
}
