// loop.c - one flight.
#include "flight/loop.h"

#include "base/constants.h"
#include "base/cpu_time.h"
#include "base/larger.h"
#include "flight/together.h"
#include <math.h>
#include <stdlib.h>

#define RECORD_S 0.01

static done_t run(flight_loop_t *f, record_t *record, outcome_t *outcome, why_t *why) {
  TRY(record_reserve(record, (int)(lround(f->plan->end_s / loop_tick_s(f)) / f->every) + 1, why));
  return together_waits(f) ? together_fly(f, record, &outcome->finite, why)
                           : loop_run(f, record, &outcome->finite, why);
}

static body_start_t start_of(const flight_loop_t *f) {
  const plan_t *plan = f->plan;
  if (!plan->vertical_only) {
    body_start_t start = plan->in_flight ? plan->start : body_standing(f->model);
    start.held = plan->held_s > 0.0;
    return start;
  }
  // On the ground it lies so deep that its springs carry what the rotors do not.
  const double each_N = plan->start_thrust_N / ROTORS;
  const double left_mps2 = larger(0.0, G_MPS2 - plan->start_thrust_N / f->model->mass_kg);
  const double z_m = plan->start_z_m > 0.0 ? plan->start_z_m : -left_mps2 / (TOUCH_POINTS * TOUCH_SPRING);
  return (body_start_t){
      .pos_w_m = {0.0, 0.0, z_m}, .thrust_N = {each_N, each_N, each_N, each_N}, .vertical_only = true};
}

// Applies this flight's random deviations to the vehicle and to the level's sensors.
static done_t draw(flight_loop_t *f, const model_t *model, drawn_t *drawn, why_t *why) {
  f->noise = f->plan->noise;
  f->own = f->plan->vertical_only ? model_point(model) : *model;
  if (f->plan->vertical_only) return DONE;
  TRY(drawn_of(&f->noise.vary, f->plan->seed, drawn, why));
  drawn_sense(drawn, &f->noise);
  return drawn_vehicle(drawn, &f->own, why);
}

static done_t begin(flight_loop_t *f, why_t *why) {
  const plan_t *plan = f->plan;
  body_start_t start = start_of(f);
  start.seed = plan->seed ^ 0x9e3779b97f4a7c15u;
  const done_t opened =
      body_open(&f->body, f->model, plan->integrate, plan->step_s > 0.0 ? plan->step_s : LOOP_TICK_S, &start);
  if (opened == BAD_INPUT)
    return error_set(
        why,
        "vehicle %s with its effects: mass, inertia, motor lag or kf not above 0; such a vehicle "
        "cannot fly",
        f->model->name);
  f->random = random_open(plan->seed);
  if (opened != DONE || !f->random) return error_failed(why, "out of memory");
  imu_init(&f->senses.imu);
  range_init(&f->senses.range);
  f->mocap = (mocap_t){0};
  ekf_init(&f->senses.ekf, &ekf_firmware, 0.0);
  if (plan->vertical_only)
    vertical_init(&f->vertical, &plan->vertical_noise, plan->period_s, start.pos_w_m.z);
  f->in.q_wb = (dq_t){1.0, 0.0, 0.0, 0.0};
  if (plan->in_flight) {
    const d3_t rest = {0.0, 0.0, -body_rest_z_m(f->model)};
    ekf_place(&f->senses.ekf, d3_add(start.pos_w_m, rest), start.vel_w_mps, dq_of(f->body.y + RIGID_Q_WB));
  }
  for (int i = 0; i < PILOT_MOTORS; i++) f->in.applied_N[i] = start.thrust_N[i];
  f->in.rotors_N = body_rotors_N(&f->body);
  f->in.vbat_V = f->body.vbat_V;
  f->pilot->reset(f->pilot->state);
  return DONE;
}

done_t loop_open(flight_loop_t **loop, const plan_t *plan, const model_t *model, const pilot_t *pilot,
                 drawn_t *drawn, why_t *why) {
  flight_loop_t *f = *loop = calloc(1, sizeof *f);
  if (!f) return error_failed(why, "out of memory");
  *f = (flight_loop_t){.plan = plan, .model = &f->own, .pilot = pilot};
  f->gap_min_m = HUGE_VAL;
  f->up_min = 1.0;
  f->range_m = f->ceiling_z_m = (double)NAN;
  f->every =
      plan->record_every > 0 ? plan->record_every : (int)lround(larger(1.0, RECORD_S / loop_tick_s(f)));
  done_t status = draw(f, model, drawn, why);
  if (status == DONE) status = begin(f, why);
  if (status == DONE) return DONE;
  loop_close(f);
  *loop = NULL;
  return status;
}

body_t *loop_body(flight_loop_t *f) {
  return &f->body;
}
model_t *loop_model(flight_loop_t *f) {
  return &f->own;
}
ekf_t *loop_estimator(flight_loop_t *f) {
  return &f->senses.ekf;
}

void loop_close(flight_loop_t *f) {
  if (!f) return;
  if (f->body.integrate) body_close(&f->body);
  random_close(f->random);
  free(f);
}

done_t loop_fly(const plan_t *plan, const model_t *model, const pilot_t *pilot, record_t *record,
                outcome_t *outcome, why_t *why) {
  record->vertical_only = plan->vertical_only;
  *outcome = (outcome_t){.finite = true};
  const double start_s = cpu_time_s();
  flight_loop_t *f;
  TRY(loop_open(&f, plan, model, pilot, &outcome->drawn, why));
  const done_t status = run(f, record, outcome, why);
  outcome->contacts = f->body.ceiling_contacts;
  outcome->realtime_factor = cpu_time_factor(plan->end_s, start_s);
  loop_close(f);
  return status;
}
