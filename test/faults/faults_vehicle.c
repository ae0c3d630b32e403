// faults_vehicle.c - a vehicle and surroundings that are not what the pilot believes.
#include "faults/faults.h"

#include <string.h>

static void mass(case_t *c) {
  c->model.mass_kg *= c->pick % 2 ? 1.0 + c->size : 1.0 - c->size;
}
static void payload(case_t *c) {
  faults_add_fx(c, "mass");
  faults_set_fx(c, "mass", 0, 0.1 * c->model.mass_kg);
  faults_set_fx(c, "mass", 2, c->onset_s);
  c->model.mass_kg *= 0.95;
}
// From the onset on all rotors get weaker over two seconds. An effect, because a flight copies its model at
// the beginning: a later change would have no effect.
static void weaken(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  const double gone = fmin(fmax((tick->t_s - use->p[0]) / 2.0, 0.0), 1.0);
  for (int i = 0; i < ROTORS; i++) fx_scale_rotor(plant, i, 1.0 - gone * (1.0 - use->p[1]), 1.0);
}
static void sag(case_t *c) {
  static const fx_t weaker = {.name = "weaker", .n_param = 2, .tick = weaken};
  const fx_use_t use = {.fx = &weaker, .p = {c->onset_s, c->size}};
  why_t why;
  if (model_add_fx(&c->model, &use, &why) != DONE) c->seen.bad = true;
}
static void motor(case_t *c) {
  faults_add_fx(c, "motor_damage");
  faults_set_fx(c, "motor_damage", 0, 1.0 + c->pick % 4);
  faults_set_fx(c, "motor_damage", 1, c->size);
  faults_set_fx(c, "motor_damage", 2, c->onset_s);
}
static void slow_motors(case_t *c) {
  faults_add_fx(c, "motor_lag");
  faults_set_fx(c, "motor_lag", 0, (c->size - 1.0) * c->model.motor_tau_s);
}
static void other_ceiling(case_t *c) {
  static const double excess[] = {0.22, 0.88, 0.0, 0.44};
  faults_set_fx(c, "ceiling", 0, excess[c->pick % 4]);
  if (c->pick % 4 == 3) faults_set_fx(c, "ceiling", 1, 160.0 * c->model.rotor_radius_m);
}
// Goes down to the floor as fast as it can, so that the thrust goes to nothing.
static void falling(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  const outer_t *o = &c->pilot.flight->outer;
  in->set.pos_w_m.z = -3.0;
  c->frozen_weights =
      o->sync.thrust.model_N < 0.25f * 9.81f * c->param.pos.mass_kg && o->sample.thrust_N < 0.1f;
}
static void take_off(case_t *c) {
  c->plan.in_flight = false;
  c->plan.take_off_s = c->onset_s;
  c->model.ceiling_m = c->model.frame.rotor_above_feet_m + c->size;
}
static void tumble(case_t *c) {
  c->onset_s = 0.0;
  c->model.ceiling_m = 3.0;
  c->plan.start.q_wb = (dq_t){cos(1.1), sin(1.1), 0.0, 0.0};
  c->plan.start.rate_b_radps = (d3_t){c->size, 0.0, 0.0};
  c->frozen_always = true;
}
// In free air, 2.2 m up with hardly more thrust than weight: two seconds at the limit.
static void weak(case_t *c) {
  c->model.ceiling_m = 100.0;
  c->param.pos.thrust_max_N = (float)(1.05 * 9.81 * c->model.mass_kg);
}
static void climbing(case_t *c, pilot_in_t *in, double since_s) {
  (void)in, (void)since_s;
  c->goal_m = c->row->gap_m - 2.2;
}
static void outdoors(case_t *c) {
  c->model.ceiling_m = HUGE_VAL;
  if (c->usual) c->param.curve.mode = CURVE_OFF;
}

// --- criteria of their own --------------------------------------------------------------------------------

static const char *gap_15_mm(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return fabs(faults_mean_m(c, &c->seen)) > 0.015 ? "gap error" : NULL;
}
static const char *overshoot_3_cm(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.rise_max_m > 0.03 ? "overshoot" : NULL;
}
static const char *no_ceiling_learned(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  if (c->seen.full_max_s > 0.21 && !(c->pilot.flight->guard.latched & GUARD_SATURATED)) return "retreat";
  return c->seen.end_gap_m > 0.3 && fabs(c->seen.ratio_end - 1.0) > 0.05 ? "ratio" : NULL;
}
static const char *trimmed(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  if (c->seen.tilt_late_deg > 5.0) return "tilt";
  return c->seen.yaw_late_deg > 10.0 ? "yaw" : NULL;
}
static const char *no_growth(const case_t *c, const flown_fault_t *usual) {
  if (c->seen.shake2_late > 2.25 * fmax(c->seen.shake2_early, usual->shake2_late)) return "growth";
  return c->seen.tilt_max_deg > 10.0 ? "tilt" : NULL;
}
static const char *weights_kept(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.weights_moved ? "weights" : NULL;
}
static const char *fell(const case_t *c, const flown_fault_t *usual) {
  return c->seen.end_gap_m < 0.3 ? "fall" : weights_kept(c, usual);
}
static const char *overshoot_2_cm(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  if (c->seen.full_total_s < 1.5) return "saturation";
  return c->seen.rise_max_m > 0.02 ? "overshoot" : NULL;
}

#define EVER FAULTS_EVER
static const row_t rows[] = {
    {"24 mass +- 20 %", 'A', 0.06, EVER, EVER, 0.2, 0.2, NULL, 0, 0, 100, mass, gap_15_mm, 0, false, false},
    {"25 payload dropped", 'A', 0.08, 0.1, 0.1, 0, 0, NULL, 0, 0, 100, payload, overshoot_3_cm, 0, false,
     false},
    {"25 payload dropped at 6 cm", 'A', 0.06, 0.1, 0.1, 0, 0, NULL, 0, 0, 100, payload, overshoot_3_cm, 0,
     false, false},
    {"26 sag to 0.7", 'N', 0.06, EVER, EVER, 0.7, 0.85, NULL, 0, 0, 100, sag, no_ceiling_learned, 0, false,
     false},
    {"27 a motor 20 % weak", 'A', 0.06, EVER, EVER, 0.2, 0.2, NULL, 0, 0, 100, motor, trimmed, 0, false,
     false},
    {"28 a motor stopped", 'C', 0.06, EVER, EVER, 1, 1, NULL, GUARD_TILT, 0.5, 100, motor, NULL, 0, false,
     false},
    {"29 motor lag x 2", 'A', 0.06, EVER, EVER, 2.0, 2.0, NULL, 0, 0, 98.3, slow_motors, no_growth, 0, false,
     false},
    {"29 motor lag x 0.5", 'A', 0.06, EVER, EVER, 0.5, 0.5, NULL, 0, 0, 100, slow_motors, no_growth, 0, false,
     false},
    {"30 another ceiling effect", 'A', 0.06, EVER, EVER, 0, 0, NULL, 0, 0, 100, other_ceiling, NULL, 0, false,
     false},
    {"36 thrust to nothing", 'N', 0.06, EVER, EVER, 0, 0, falling, 0, 0, 100, NULL, fell, 0, false, false},
    {"39 two seconds of full thrust", 'N', 0.06, EVER, EVER, 0, 0, climbing, 0, 0, 100, weak, overshoot_2_cm,
     0, false, false},
    {"40 take-off under a ceiling", 'N', 0.06, EVER, EVER, 0.03, 0.1, NULL, 0, 0, 100, take_off, NULL, 0,
     false, false},
    {"41 no ceiling ever seen", 'N', 0.06, EVER, EVER, 0, 0, NULL, 0, 0, 100, outdoors, NULL, 0, true, false},
    {"42 thrown upside down", 'N', 0.06, EVER, EVER, -5, 5, NULL, GUARD_TILT, 0.03, 100, tumble, weights_kept,
     0, false, false},
};

rows_t faults_of_vehicle(void) {
  return (rows_t){rows, (int)(sizeof rows / sizeof *rows)};
}
