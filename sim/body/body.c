// body.c - a vehicle with six degrees of freedom in its surroundings.
#include "body/body.h"

#include "base/constants.h"
#include "base/few.h"
#include "plant/rigid.h"
#include <math.h>
#include <string.h>

double body_rest_z_m(const model_t *model) {
  return model->frame.cg_above_feet_m;
}
body_start_t body_standing(const model_t *model) {
  const d3_t up = model_floor_up_w(model); // the shortest turn from level to it
  return (body_start_t){.pos_w_m = d3_scale(body_rest_z_m(model), up),
                        .q_wb = dq_unit((dq_t){1.0 + up.z, -up.y, up.x, 0.0})};
}
double body_rotor_z_m(const model_t *model) {
  return model->frame.rotor_above_feet_m - model->frame.cg_above_feet_m;
}

static void look_now(body_t *b) {
  body_look(b, TOUCH_FLOOR | TOUCH_CEILING | TOUCH_WALL, b->y, &b->look);
  b->look_is_y = true;
}

// --- opening --------------------------------------------------------------------------------------------

static void collect_effects(body_t *b) {
  for (int k = 0; k < b->model->n_fx; k++) {
    const fx_use_t *use = &b->model->fx[k];
    if (use->fx->excess) {
      b->excess[b->n_excess++] = use;
      b->excess_of |= body_surfaces_of(use);
    }
    if (use->fx->load) b->load[b->n_load++] = use;
    if (use->fx->tick && use->fx->steady) use->fx->tick(use, NULL, &b->untouched);
    if (use->fx->tick && !use->fx->steady) b->tick[b->n_tick++] = use;
    if (use->fx->sense) b->n_sense++;
  }
}

static void take_start(body_t *b, const body_start_t *start) {
  const dq_t q = start->q_wb;
  const bool level = !(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z > 0.0);
  d3_put(b->y + RIGID_POS_M, start->pos_w_m);
  d3_put(b->y + RIGID_VEL_MPS, start->vel_w_mps);
  d3_put(b->y + RIGID_RATE_RADPS, start->rate_b_radps);
  b->y[RIGID_Q_WB] = level ? 1.0 : q.w;
  d3_put(b->y + RIGID_Q_WB + 1, d3(q.x, q.y, q.z));
  rigid_normalise(b->y);
  for (int i = 0; i < ROTORS; i++) b->y[RIGID_THRUST_N + i] = b->command_N[i] = start->thrust_N[i];
  // With a delay of k ticks, the first k commands are what the motors do already.
  for (int i = 0; i < BODY_QUEUE; i++) memcpy(b->queue_N[i], start->thrust_N, sizeof b->queue_N[i]);
  b->rigid.vertical_only = start->vertical_only;
  b->rigid.held = start->held;
  b->charge = 1.0 - start->discharged;
}

// left: the share of each rotor's current that remains where its inflow is hindered; null: all.
static void look_at_battery(body_t *b, const double *left) {
  b->current_A = battery_current_A(&b->model->battery, b->y + RIGID_THRUST_N, left, ROTORS);
  b->vbat_V = battery_voltage_V(&b->model->battery, b->charge, b->current_A);
}

static bool model_is_good(const model_t *m) {
  const frame_t *f = &m->frame;
  return m->mass_kg > 0.0 && m->motor_tau_s >= 0.0 && f->kf_Ns2 > 0.0 && f->inertia_kgm2[0] > 0.0 &&
         f->inertia_kgm2[1] > 0.0 && f->inertia_kgm2[2] > 0.0;
}

done_t body_open(body_t *b, const model_t *model, integrate_kind_t kind, double step_s,
                 const body_start_t *start) {
  memset(b, 0, sizeof *b);
  if (!model_is_good(model)) return BAD_INPUT;
  const frame_t *f = &model->frame;
  b->model = model;
  b->plant = b->untouched = body_untouched(model);
  b->rigid = (rigid_t){.mass_kg = model->mass_kg,
                       .inertia_kgm2 = d3_of(f->inertia_kgm2),
                       .torque_ratio_m = f->torque_ratio_m,
                       .kf_Ns2 = f->kf_Ns2,
                       .rotor_inertia_kgm2 = f->rotor_inertia_kgm2,
                       .motor_tau_s = model->motor_tau_s,
                       .motor_down_over_up = model->motor_down_over_up,
                       .lag_up_square = model->lag_square[0],
                       .lag_down_square = model->lag_square[1],
                       .lag_steady_N = model_steady_N(model),
                       .lag_in_speed = model->lag_in_speed,
                       .torque_scale = {1.0, 1.0, 1.0, 1.0}};
  rigid_tune(&b->rigid);
  memcpy(b->rigid.thrust_scale, b->plant.thrust_scale, sizeof b->rigid.thrust_scale);
  memcpy(b->rigid.spin, f->rotor_spin, sizeof b->rigid.spin);
  body_surround(&b->touch, model);
  body_place(b, b->plant.cg_b_m);
  collect_effects(b);
  take_start(b, start);
  look_at_battery(b, NULL);
  b->random = random_open(start->seed);
  if (!b->random) return FAILED;
  body_effects(b, 0.0);
  look_now(b);
  const touch_gap_t gap = body_clearance(b);
  b->on_floor = gap.floor_m < BODY_RELEASE_M;
  b->on_ceiling = gap.ceiling_m < BODY_RELEASE_M;
  b->kind = kind;
  b->step_s = step_s;
  const ode_t ode = {.n = RIGID_N, .derivative = body_next_derivative, .context = b, .step_s = step_s};
  const done_t status = integrate_open(&b->integrate, kind, &ode);
  if (status != DONE) body_close(b);
  return status;
}

void body_hold(body_t *b, bool held) {
  b->rigid.held = held;
  b->changed++;
  for (int i = 0; held && i < 3; i++) b->y[RIGID_VEL_MPS + i] = b->y[RIGID_RATE_RADPS + i] = 0.0;
  b->look_is_y = false;
  look_now(b);
}

void body_push(body_t *b, d3_t force_w_N) {
  b->pushed = true;
  b->changed++;
  b->push = (push_t){force_w_N, d3(0.0, 0.0, 0.0)};
  b->look_is_y = false;
}

void body_shake(body_t *b, push_t push) {
  if (!b->pushed) b->changed++; // seen by code that moves it with others
  b->pushed = true;
  b->push = push;
  b->look_is_y = false;
}

void body_close(body_t *b) {
  integrate_close(b->integrate);
  random_close(b->random);
  b->integrate = NULL;
  b->random = NULL;
}

// --- a tick ---------------------------------------------------------------------------------------------

int body_touched(bool *on, double gap_m) {
  const bool was = *on;
  *on = gap_m <= 0.0 || (was && gap_m < BODY_RELEASE_M);
  return *on && !was;
}

static void watch_contacts(body_t *b) {
  const axes_t axes = axes_of(dq_of(b->y + RIGID_Q_WB));
  const touch_gap_t gap = touch_gap(&b->touch, d3_of(b->y + RIGID_POS_M), &axes);
  b->floor_contacts += body_touched(&b->on_floor, gap.floor_m);
  b->ceiling_contacts += body_touched(&b->on_ceiling, gap.ceiling_m);
}

int body_parts(int surfaces, double span_s) {
  return surfaces ? (int)ceil(span_s / TOUCH_STEP_S - 1e-9) : 1;
}

static void advance(body_t *b, double span_s) {
  b->surfaces = body_near(b, span_s);
  const int parts = body_parts(b->surfaces, span_s);
  for (int i = 0; i < parts && !b->broken; i++) {
    b->broken = !integrate_to(b->integrate, b->y, span_s / parts);
    if (b->surfaces || b->on_floor || b->on_ceiling) watch_contacts(b);
  }
}

unsigned body_delay_ticks(const body_t *b) {
  const double wanted = b->plant.delay_s > 0.0 ? b->plant.delay_s / b->span_s + 0.5 : 0.0;
  return wanted < BODY_QUEUE ? (unsigned)wanted : BODY_QUEUE - 1;
}

static void delay_commands(body_t *b) {
  const unsigned ticks = body_delay_ticks(b);
  double *const last_N = b->queue_N[b->queued % BODY_QUEUE];
  const double *const due_N = b->queue_N[(b->queued - ticks) % BODY_QUEUE];
  for (int i = 0; i < ROTORS; i += FEW_N) few_put(last_N + i, few_of(b->command_N + i));
  for (int i = 0; i < ROTORS; i += FEW_N) few_put(b->rigid.command_N + i, few_of(due_N + i));
  b->queued++;
}

// For rotors without a lag.
static void take_commands(body_t *b) {
  memcpy(b->y + RIGID_THRUST_N, b->rigid.command_N, sizeof b->rigid.command_N);
  b->look_is_y = false;
  b->changed++;
}

void body_tick_begin(body_t *b) {
  if (b->n_tick > 0) {
    body_effects(b, b->span_s);
    b->look_is_y = false;
  }
  delay_commands(b);
  if (b->rigid.motor_tau_s < LAG_LEAST_S) take_commands(b);
}

void body_tick_alone(body_t *b) {
  b->changed++;
  const double span_s = b->span_s;
  const int chunks = span_s > BODY_CHUNK_S ? (int)ceil(span_s / BODY_CHUNK_S - 1e-9) : 1;
  for (int i = 0; i < chunks && !b->broken; i++) advance(b, span_s / chunks);
  rigid_normalise(b->y);
  look_now(b);
}

void body_tick_end(body_t *b) {
  const double span_s = b->span_s;
  b->broken = b->broken || !isfinite(b->y[RIGID_POS_M + 2]) || !isfinite(b->y[RIGID_Q_WB]);
  b->charge = battery_discharge(&b->model->battery, b->charge, b->current_A, span_s);
  double left[ROTORS];
  body_current_left(b, left);
  look_at_battery(b, left);
  b->t_s += span_s;
}

void body_command(body_t *b, const double command_N[ROTORS], double span_s) {
  const few_t min_N = few_all(b->model->thrust_min_N / ROTORS),
              max_N = few_all(b->model->thrust_max_N / ROTORS);
  for (int i = 0; i < ROTORS; i += FEW_N) // NaN becomes the minimum
    few_put(b->command_N + i, few_min(few_max(few_of(command_N + i), min_N), max_N));
  b->span_s = span_s;
}

void body_tick(body_t *b, const double command_N[ROTORS], double span_s) {
  body_command(b, command_N, span_s);
  body_tick_begin(b);
  body_tick_alone(b);
  body_tick_end(b);
}

// --- looking ----------------------------------------------------------------------------------------------

double body_thrust_ratio(const body_t *b, int rotor) {
  return b->look.ratio[rotor];
}

double body_rotor_radps(const body_t *b, int rotor) {
  return b->look.turning[rotor] * b->look.speed_radps[rotor];
}

touch_gap_t body_clearance(const body_t *b) {
  return touch_gap(&b->touch, d3_of(b->y + RIGID_POS_M), &b->look.axes);
}
