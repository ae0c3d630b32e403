// rig6.c - a small rigid body for tests of pilots.
#include "rig/rig6.h"

#include <string.h>

#define G_MPS2 9.81

// Positions of the motors, in arms, and the sign of their drag torque on the body.
static const double ahead[PILOT_MOTORS] = {1, -1, -1, 1}, left[PILOT_MOTORS] = {-1, -1, 1, 1};
static const double twist[PILOT_MOTORS] = {-1, 1, -1, 1};

typedef struct {
  d3_t pos, vel, rate;
  dq_t q;
  double force[PILOT_MOTORS];
} state_t;

rig6_param_t rig6_crazyflie(void) {
  return (rig6_param_t){
      .mass_kg = 0.0329,
      .inertia_kgm2 = {16.57e-6, 16.66e-6, 29.26e-6},
      .arm_m = 0.0325,
      .torque_m = 0.00735,
      .speed_N = 2.0e-8,
      .tau_s = 0.057,
      .ceiling_m = (double)NAN,
      .radius_m = 0.0235,
  };
}

rig6_t rig6_at(const rig6_param_t *param, d3_t pos_w_m, double yaw_rad, bool hovering) {
  rig6_t r = {
      .param = *param,
      .pos_w_m = pos_w_m,
      .q_wb = {cos(0.5 * yaw_rad), 0.0, 0.0, sin(0.5 * yaw_rad)},
      .vbat_V = 3.9,
  };
  if (hovering)
    for (int i = 0; i < PILOT_MOTORS; i++)
      r.force_N[i] = r.command_N[i] = param->mass_kg * G_MPS2 / PILOT_MOTORS;
  return r;
}

// Returns the thrust of motor i over its thrust in free air.
static double ratio(const rig6_param_t *p, const state_t *s, int i) {
  if (isnan(p->ceiling_m)) return 1.0;
  const d3_t at = dq_to_world(s->q, (d3_t){p->arm_m * ahead[i], p->arm_m * left[i], 0.0});
  const double d = fmax(p->ceiling_m - s->pos.z - at.z, 1e-3) / p->radius_m;
  return 0.5 + 0.5 * sqrt(1.0 + 1.0 / (8.0 * d * d));
}

static d3_t specific_force(const rig6_param_t *p, const state_t *s) {
  double sum = 0.0;
  for (int i = 0; i < PILOT_MOTORS; i++) sum += ratio(p, s, i) * s->force[i];
  return (d3_t){0.0, 0.0, sum / p->mass_kg};
}

static d3_t moments(const rig6_param_t *p, const state_t *s, const double slope[PILOT_MOTORS]) {
  d3_t m = {0.0, 0.0, 0.0};
  for (int i = 0; i < PILOT_MOTORS; i++) {
    const double f = ratio(p, s, i) * s->force[i];
    const double speed = sqrt(fmax(s->force[i], 1e-4) / p->speed_N);
    m.x += p->arm_m * left[i] * f;
    m.y -= p->arm_m * ahead[i] * f;
    m.z += twist[i] * (p->torque_m * f + p->rotor_kgm2 * slope[i] / (2.0 * p->speed_N * speed));
  }
  return m;
}

static state_t slope_of(const rig6_t *r, const state_t *s) {
  const rig6_param_t *p = &r->param;
  const d3_t J = p->inertia_kgm2, w = s->rate;
  state_t d = {.pos = s->vel};
  for (int i = 0; i < PILOT_MOTORS; i++) d.force[i] = (r->command_N[i] - s->force[i]) / p->tau_s;
  d.vel = d3_add(dq_to_world(s->q, specific_force(p, s)), (d3_t){0.0, 0.0, -G_MPS2});
  const d3_t m = moments(p, s, d.force);
  d.rate = (d3_t){(m.x - (J.z - J.y) * w.y * w.z) / J.x, (m.y - (J.x - J.z) * w.z * w.x) / J.y,
                  (m.z - (J.y - J.x) * w.x * w.y) / J.z};
  const dq_t turn = dq_mul(s->q, (dq_t){0.0, w.x, w.y, w.z});
  d.q = (dq_t){0.5 * turn.w, 0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z};
  return d;
}

static state_t moved(const state_t *s, double h, const state_t *d) {
  state_t to = {
      .pos = d3_add(s->pos, d3_scale(h, d->pos)),
      .vel = d3_add(s->vel, d3_scale(h, d->vel)),
      .rate = d3_add(s->rate, d3_scale(h, d->rate)),
      .q = {s->q.w + h * d->q.w, s->q.x + h * d->q.x, s->q.y + h * d->q.y, s->q.z + h * d->q.z},
  };
  for (int i = 0; i < PILOT_MOTORS; i++) to.force[i] = s->force[i] + h * d->force[i];
  return to;
}

static state_t runge_kutta(const rig6_t *r, const state_t *s, double h) {
  const state_t k1 = slope_of(r, s), at1 = moved(s, 0.5 * h, &k1);
  const state_t k2 = slope_of(r, &at1), at2 = moved(s, 0.5 * h, &k2);
  const state_t k3 = slope_of(r, &at2), at3 = moved(s, h, &k3);
  const state_t k4 = slope_of(r, &at3);
  state_t to = moved(s, h / 6.0, &k1);
  to = moved(&to, h / 3.0, &k2);
  to = moved(&to, h / 3.0, &k3);
  return moved(&to, h / 6.0, &k4);
}

static state_t state_of(const rig6_t *r) {
  state_t s = {.pos = r->pos_w_m, .vel = r->vel_w_mps, .rate = r->rate_b_radps, .q = r->q_wb};
  memcpy(s.force, r->force_N, sizeof s.force);
  return s;
}

static bool stands(const rig6_t *r) {
  return r->param.floor && r->pos_w_m.z <= 0.0 && r->vel_w_mps.z <= 0.0;
}

pilot_in_t rig6_sense(const rig6_t *r, const pilot_setpoint_t *set) {
  const state_t s = state_of(r);
  const d3_t rest = dq_to_body(r->q_wb, (d3_t){0.0, 0.0, G_MPS2});
  pilot_in_t in = {
      .step = r->step,
      .gyro_b_radps = r->rate_b_radps,
      .acc_b_mps2 = d3_add(stands(r) ? rest : specific_force(&r->param, &s), r->param.acc_bias_b_mps2),
      .pos_w_m = r->pos_w_m,
      .vel_w_mps = r->vel_w_mps,
      .q_wb = r->q_wb,
      .vbat_V = r->vbat_V,
      .range_m = (double)NAN,
      .set = *set,
  };
  memcpy(in.applied_N, r->command_N, sizeof in.applied_N);
  return in;
}

void rig6_step(rig6_t *r, const double motor_N[PILOT_MOTORS]) {
  memcpy(r->command_N, motor_N, sizeof r->command_N);
  const state_t from = state_of(r), to = runge_kutta(r, &from, PILOT_PERIOD_S);
  r->pos_w_m = to.pos;
  r->vel_w_mps = to.vel;
  r->rate_b_radps = to.rate;
  r->q_wb = dq_unit(to.q);
  memcpy(r->force_N, to.force, sizeof r->force_N);
  r->step++;
  const double top_m = r->param.ceiling_m - RIG6_TOUCH_M; // NaN without a plate
  if (r->pos_w_m.z > top_m) {
    r->pos_w_m.z = top_m;
    r->vel_w_mps.z = fmin(r->vel_w_mps.z, 0.0);
  }
  if (!stands(r)) return;
  r->pos_w_m.z = 0.0;
  r->vel_w_mps = r->rate_b_radps = (d3_t){0.0, 0.0, 0.0};
  r->q_wb = from.q;
}

void rig6_fly(rig6_t *r, const pilot_t *pilot, const pilot_setpoint_t *set, double seconds,
              void (*watch)(const rig6_t *, void *), void *user) {
  const long n = lround(seconds / PILOT_PERIOD_S);
  for (long i = 0; i < n; i++) {
    double motor_N[PILOT_MOTORS];
    const pilot_in_t in = rig6_sense(r, set);
    pilot->step(pilot->state, &in, motor_N);
    rig6_step(r, motor_N);
    if (watch) watch(r, user);
  }
}

double rig6_yaw_rad(const rig6_t *r) {
  const d3_t nose = dq_to_world(r->q_wb, (d3_t){1.0, 0.0, 0.0});
  return atan2(nose.y, nose.x);
}

double rig6_tilt_rad(const rig6_t *r) {
  return acos(fmin(dq_to_world(r->q_wb, (d3_t){0.0, 0.0, 1.0}).z, 1.0));
}

pilot_setpoint_t rig6_hold(d3_t pos_w_m, double yaw_rad) {
  return (pilot_setpoint_t){
      .mode = {PILOT_POSITION, PILOT_POSITION, PILOT_POSITION}, .pos_w_m = pos_w_m, .yaw_rad = yaw_rad};
}

pilot_setpoint_t rig6_go(d3_t vel_w_mps, double z_m, double yaw_rad) {
  return (pilot_setpoint_t){.mode = {PILOT_VELOCITY, PILOT_VELOCITY, PILOT_POSITION},
                            .pos_w_m = {0.0, 0.0, z_m},
                            .vel_mps = vel_w_mps,
                            .yaw_rad = yaw_rad};
}
