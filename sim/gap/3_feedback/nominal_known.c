// nominal_known.c - the nominal flights' pilot where the vehicle file says who flew.
#include "gap/3_feedback/nominal_known.h"

#include "pilots/pilot_flight.h"
#include <math.h>
#include <stdlib.h>

#define RANGE_S 0.1   // s, between samples of an upward range sensor if the vehicle file does not say
#define FLOOR_M 0.040 // m, least reading of such a sensor

struct known {
  const model_t *m;
  const flown_by_t *by;
  bool range_up;
  stock_pid_t pid;
  pilot_flight_t flight; // FLOWN_BY_INDI
  pilot_t pilot;
  pilot_in_t in;
  double due_s, range_due_s; // s, since the last call, and since the last sample of the range sensor
  double motor_N[ROTORS];
};

static bool by_pid(const known_t *k) {
  return k->by->kind == FLOWN_BY_STOCK_PID;
}

// --- what the pilot is told -------------------------------------------------------------------------------

static double yaw_of(dq_t q) {
  return atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

static double ahead(const pid_gain_t *p, double mps) {
  return p->kp > 0.0 ? mps / p->kp : 0.0;
}

// Takes the log's own set points, axis by axis: a place, a speed alone, or both.
static void take_logged(pilot_setpoint_t *set, const grid_point_t *track) {
  const double place_m[3] = {track->set_w_m.x, track->set_w_m.y, track->set_w_m.z};
  const double speed_mps[3] = {track->set_w_mps.x, track->set_w_mps.y, track->set_w_mps.z};
  double *const to_m[3] = {&set->pos_w_m.x, &set->pos_w_m.y, &set->pos_w_m.z};
  double *const to_mps[3] = {&set->vel_mps.x, &set->vel_mps.y, &set->vel_mps.z};
  for (int i = 0; i < 3; i++) {
    const bool place = isfinite(place_m[i]), speed = isfinite(speed_mps[i]);
    if (place) *to_m[i] = place_m[i];
    if (place || speed) *to_mps[i] = speed ? speed_mps[i] : 0.0;
    if (speed && !place) set->mode[i] = PILOT_VELOCITY;
  }
  if (isfinite(track->set_yaw_rad)) set->yaw_rad = track->set_yaw_rad;
}

static void order(known_t *k, const grid_point_t *track) {
  pilot_setpoint_t *const set = &k->in.set;
  const pid_gain_t *pos = k->by->pid.position.pos;
  const d3_t v = track->vel_w_mps;
  for (int i = 0; i < 3; i++) set->mode[i] = PILOT_POSITION;
  set->pos_w_m = track->pos_w_m;
  set->vel_mps = v;
  if (by_pid(k))
    set->pos_w_m = d3_add(set->pos_w_m, d3(ahead(&pos[0], v.x), ahead(&pos[1], v.y), ahead(&pos[2], v.z)));
  set->yaw_rad = yaw_of(track->q_wb);
  take_logged(set, track);
}

static void show(known_t *k, const grid_point_t *seen, double step_s) {
  k->range_due_s += step_s;
  k->in.range_new =
      k->range_up && k->range_due_s >= (k->m->range_up.told ? k->m->range_up.period_s : RANGE_S);
  if (k->in.range_new) k->range_due_s = 0.0;
  k->in.gyro_b_radps = seen->rate_b_radps;
  k->in.acc_b_mps2 = seen->acc_b_mps2;
  k->in.pos_w_m = seen->pos_w_m;
  k->in.vel_w_mps = seen->vel_w_mps;
  k->in.q_wb = seen->q_wb;
  k->in.vbat_V = seen->vbat_V;
  k->in.range_m = fmax(seen->range_m, k->m->range_up.told ? k->m->range_up.floor_m : FLOOR_M);
}

// --- the firmware's PID -----------------------------------------------------------------------------------

// Converts the firmware's units to newton. Battery compensation is taken to be perfect, so units are thrust.
// As in the firmware, all are lowered by the excess of the largest over full scale.
static void newton(const known_t *k, const double unit[ROTORS], double motor_N[ROTORS]) {
  const double per_unit = k->by->pid.power.thrust_max_N / STOCK_FULL;
  double most = STOCK_FULL;
  for (int i = 0; i < ROTORS; i++) most = fmax(most, unit[i]);
  for (int i = 0; i < ROTORS; i++) {
    const double whole_N = per_unit * fmax(unit[i] - (most - STOCK_FULL), 0.0);
    motor_N[i] = fmin(whole_N, k->m->thrust_max_N / ROTORS);
  }
}

static double held(const pid_gain_t *p, double output) {
  return p->ki > 0.0 ? fmax(-p->integral_max, fmin(p->integral_max, output / p->ki)) : 0.0;
}

// Sets the integrals to those of a hovering vehicle: the mixer's inverse of the motors that hold it.
static void settle(known_t *k, const double motor_N[ROTORS]) {
  stock_pid_t *const s = &k->pid;
  const stock_position_param_t *p = &s->param.position;
  const double full = STOCK_FULL / s->param.power.thrust_max_N;
  const double u[ROTORS] = {full * motor_N[0], full * motor_N[1], full * motor_N[2], full * motor_N[3]};
  const double thrust = 0.25 * (u[0] + u[1] + u[2] + u[3]), roll = 0.5 * (-u[0] - u[1] + u[2] + u[3]);
  const double pitch = 0.5 * (u[0] - u[1] - u[2] + u[3]), yaw = 0.25 * (u[0] - u[1] + u[2] - u[3]);
  (void)stock_pid_command(s, &k->in); // changes the modes now, which clears the integrals that follow
  s->position.vel[2].integral = held(&p->vel[2], (thrust - p->thrust_base) / p->thrust_scale);
  s->rate[0].integral = held(&s->param.rate[0], roll);
  s->rate[1].integral = held(&s->param.rate[1], pitch);
  s->rate[2].integral = held(&s->param.rate[2], -yaw);
}

// --- the whole --------------------------------------------------------------------------------------------

// Opens the flight code itself, with the parameters of the vehicle file.
static done_t open_flight(known_t *k, why_t *why) {
  const model_t *const m = k->m;
  flight_param_t param;
  params_default(&param);
  param.pos.mass_kg = (float)m->mass_kg;
  param.motor_tau_s = (float)m->motor_tau_s;
  for (int i = 0; i < k->by->n_set; i++) {
    const param_row_t *const row = params_find(k->by->set[i].name);
    if (!row || params_set(&param, row, (float)k->by->set[i].value) != ST_OK)
      return error_set(why, "%s: the flight code has no such parameter", k->by->set[i].name);
  }
  if (pilot_flight_init(&k->flight, &param, m, &k->pilot) == DONE) return DONE;
  return error_set(why, "%s: the flight code cannot fly it with its [controller]", m->name);
}

done_t known_open(known_t **known, const nominal_flight_t *f, const grid_point_t *seen, why_t *why) {
  known_t *const k = *known = calloc(1, sizeof *k);
  if (!k) return error_failed(why, "out of memory");
  k->m = f->body.model;
  k->by = f->w->flown_by;
  k->range_up = f->g->range_up;
  for (int i = 0; i < ROTORS; i++) k->in.applied_N[i] = f->body.command_N[i];
  order(k, seen);
  show(k, seen, 0.0);
  if (!by_pid(k)) return open_flight(k, why);
  k->pid.param = k->by->pid;
  stock_pid_reset(&k->pid);
  settle(k, f->body.command_N);
  return DONE;
}

void known_steer(known_t *k, double step_s, const grid_point_t *track, const grid_point_t *seen,
                 double motor_N[ROTORS]) {
  double unit[ROTORS];
  order(k, track);
  show(k, seen, step_s);
  for (k->due_s += step_s; k->due_s > 0.5 * PILOT_PERIOD_S; k->due_s -= PILOT_PERIOD_S) {
    if (by_pid(k)) {
      stock_mix(stock_pid_command(&k->pid, &k->in), unit);
      newton(k, unit, k->motor_N);
    } else
      k->pilot.step(k->pilot.state, &k->in, k->motor_N);
    k->in.step++;
    k->in.range_new = false;
  }
  for (int i = 0; i < ROTORS; i++)
    k->in.applied_N[i] = motor_N[i] = fmax(0.0, fmin(k->motor_N[i], k->m->thrust_max_N / ROTORS));
}
