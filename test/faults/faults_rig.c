// faults_rig.c - flies one case: a hover under the ceiling with real sensors; the fault acts between them and
// the pilot.
#include "faults/faults.h"

#include "rig/test.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

void faults_set_fx(case_t *c, const char *name, int p, double value) {
  for (int i = 0; i < c->model.n_fx; i++)
    if (c->model.fx[i].fx == fx_find(name)) c->model.fx[i].p[p] = value;
}

void faults_add_fx(case_t *c, const char *name) {
  why_t why;
  const fx_use_t use = fx_use(fx_find(name));
  if (model_add_fx(&c->model, &use, &why) != DONE) c->seen.bad = true;
}

static double flown_height_m(const case_t *c, double gap_m) {
  return FAULTS_CEILING_M - gap_m - body_rotor_z_m(&c->model) - body_rest_z_m(&c->model);
}

static void fault(void *context, const body_t *truth, pilot_in_t *in) {
  case_t *const c = context;
  faults_watch(c, truth);
  const double since_s = c->t_s - c->onset_s;
  const bool active = since_s > -5e-4 && since_s < c->length_s - 5e-4;
  c->skip = c->twice = false;
  c->frozen_weights = c->frozen_always;
  // The commanded gap, which rows may change.
  if (c->plan.in_flight) in->set.pos_w_m.z = flown_height_m(c, c->goal_m);
  if (active && c->row->edit && !c->usual) c->row->edit(c, in, since_s);
  in->step += c->step_off;
  c->weights_before = c->pilot.flight->outer.learn.rls.theta;
  c->t_s += PILOT_PERIOD_S;
}

// FNV-1a over the motor commands, 64 bits at a time. The upper half is mixed in once more below, because the
// product loses it.
static uint64_t mixed(uint64_t bits, const double motor_N[PILOT_MOTORS]) {
  uint64_t raw[PILOT_MOTORS];
  memcpy(raw, motor_N, sizeof raw);
  for (int i = 0; i < PILOT_MOTORS; i++) bits = ((bits ^ raw[i]) * 1099511628211u) ^ raw[i] >> 32;
  return bits;
}

// After each millisecond.
static void after(void *state, const pilot_in_t *in, const double motor_N[PILOT_MOTORS]) {
  case_t *const c = state;
  if (c->with_shadow) {
    double shadow_N[PILOT_MOTORS];
    c->shadow_pilot.step(c->shadow_pilot.state, in, shadow_N);
    if (memcmp(shadow_N, motor_N, sizeof shadow_N) != 0) c->seen.shadow_differs = true;
  }
  if (c->frozen_weights &&
      memcmp(&c->weights_before, &c->pilot.flight->outer.learn.rls.theta, sizeof c->weights_before) != 0)
    c->seen.weights_moved = true;
  c->seen.bits = mixed(c->seen.bits, motor_N);
}

static void step(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  case_t *const c = state;
  if (!c->skip) c->inner.step(c->inner.state, in, motor_N);
  if (c->twice) c->inner.step(c->inner.state, in, motor_N);
  after(state, in, motor_N);
}

pilot_flight_t *faults_pilot(case_t *c) {
  crazyflie_home(&c->pilot.vehicle);
  return &c->pilot;
}

// The fields of the app that are read here, by faults_watch() and by the rows.
#define LOOKED(field)                                                                                        \
  { offsetof(glue_t, flight.field), offsetof(glue_t, flight.field) + sizeof(((glue_t *)0)->flight.field) }
static const pilot_part_t looked[] = {
    LOOKED(due),
    LOOKED(outer.learn.rls.theta),
    LOOKED(outer.learn.rls.P),
    LOOKED(outer.sync.thrust.model_N),
    LOOKED(outer.started),
    LOOKED(outer.sample.thrust_N),
    LOOKED(outer.param.pos.thrust_max_N),
    LOOKED(outer.param.mixer.force_max_N),
    LOOKED(out.motors.force_N),
    LOOKED(out.motors.thrust_N),
    LOOKED(out.outer.thrust_N),
    LOOKED(out.outer.zc_m),
    LOOKED(out.outer.zc_known),
    LOOKED(out.outer.at.ratio),
    LOOKED(guard.now),
    LOOKED(guard.latched),
    LOOKED(guard.action),
};
static const pilot_around_t around = {looked, sizeof looked / sizeof *looked, after};

static void reset(void *state) {
  case_t *const c = state;
  c->inner.reset(c->inner.state);
}

static void draw(case_t *c, const row_t *row, uint64_t seed) {
  c->row = row;
  c->r = random_open(seed ^ 0x5bd1e995u);
  c->onset_s = FAULTS_HOVER_S + 1e-3 * floor(1000.0 * random_uniform(c->r, 0.0, 0.2));
  c->length_s = row->length_lo + (row->length_hi - row->length_lo) * random_uniform(c->r, 0.0, 1.0);
  c->length_s = 1e-3 * ceil(1000.0 * c->length_s - 1e-6);
  c->size = random_uniform(c->r, row->size_lo, row->size_hi);
  c->pick = (unsigned)(random_uniform(c->r, 0.0, 1.0) * 4294967295.0);
  c->goal_m = row->gap_m;
}

static void place(case_t *c) {
  c->plan.start.pos_w_m.z = FAULTS_CEILING_M - c->row->gap_m - body_rotor_z_m(&c->model);
  const fx_place_t place = {c->row->gap_m, HUGE_VAL, c->model.rotor_radius_m};
  for (int i = 0; i < ROTORS; i++)
    c->plan.start.thrust_N[i] = c->model.mass_kg * 9.81 / ROTORS / model_thrust_ratio(&c->model, &place);
  c->seen.hover_N = ROTORS * c->plan.start.thrust_N[0];
}

// Read once, because reading the vehicle's file would cost 4 % of each flight.
static setup_t thesis;
static bool thesis_read;
static void read_thesis(void) {
  why_t why;
  thesis_read = setup_thesis(&thesis, FLY_INDI, &why) == DONE;
}

// Default parameters, with the vehicle's mass and lag. The curve is learned all the time.
static bool prepare(case_t *c, const row_t *row, uint64_t seed) {
  static pthread_once_t once = PTHREAD_ONCE_INIT;
  (void)pthread_once(&once, read_thesis);
  if (!thesis_read) return false;
  draw(c, row, seed);
  c->model = thesis.model;
  params_default(&c->param);
  c->param.pos.mass_kg = thesis.flight.pos.mass_kg;
  c->param.motor_tau_s = thesis.flight.motor_tau_s;
  c->param.curve.mode = CURVE_LIVE;
  c->plan = thesis.plan;
  c->plan.seed = seed;
  c->plan.integrate = INTEGRATE_RK4;
  c->plan.end_s = FAULTS_END_S;
  c->plan.n_way = 1;
  c->plan.way[0] = (waypoint_t){0.0, FAULTS_CEILING_M - row->gap_m};
  c->plan.in_flight = true;
  if (row->begin && (!c->usual || row->same_bits)) row->begin(c);
  place(c);
  c->plan.record_every = 1 << 30; // nobody reads it
  c->plan.edit = fault;
  c->plan.edit_context = c;
  return pilot_flight_init(&c->pilot, &c->param, &c->model, &c->inner) == DONE &&
         pilot_flight_init(&c->shadow, &c->param, &c->model, &c->shadow_pilot) == DONE;
}

void faults_fly(case_t *c, const row_t *row, uint64_t seed, bool usual) {
  *c = (case_t){
      .usual = usual, .seen = FAULTS_UNSEEN, .tilt_cosine = 1.0, .late_cosine = 1.0, .yaw_cosine = 1.0};
  if (!prepare(c, row, seed)) {
    c->seen.bad = true;
    return;
  }
  const pilot_t pilot = {
      .state = c, .step = step, .reset = reset, .vehicle = &c->pilot.vehicle, .around = &around};
  why_t why;
  record_t record = {0};
  outcome_t outcome = {0};
  const done_t status = loop_fly(&c->plan, &c->model, &pilot, &record, &outcome, &why);
  c->seen.bad = c->seen.bad || status != DONE || !outcome.finite;
  c->seen.ratio_end = (double)c->pilot.flight->out.outer.at.ratio;
  record_free(&record);
  random_close(c->r);
}
