// rigid.c - a rigid body with four rotors.
#include "plant/rigid.h"

#include <string.h>

void rigid_tune(rigid_t *r) {
  r->per_mass = 1.0 / r->mass_kg;
  r->per_tau = 1.0 / r->motor_tau_s;
  r->per_root_kf = 1.0 / sqrt(r->kf_Ns2);
  r->per_inertia = d3(1.0 / r->inertia_kgm2.x, 1.0 / r->inertia_kgm2.y, 1.0 / r->inertia_kgm2.z);
}

void rigid_rotor_radps(const rigid_t *r, const double f[ROTORS], double speed[ROTORS]) {
  for (int i = 0; i < ROTORS; i++) {
    const double at = f[i] > 0.0 ? sqrt(f[i]) * r->per_root_kf : 0.0;
    speed[i] = at > ROTOR_SLOWEST_RADPS ? at : ROTOR_SLOWEST_RADPS;
  }
}

// Thrust, its moment, and what the rotors' torque and inertia do.
typedef struct {
  double thrust_N;
  d3_t moment_b_Nm;
  double spin_Nms; // angular momentum of the rotors along z
} rotors_t;

static rotors_t rotors(const rigid_t *r, const double *f, const double *speed, const double *ratio,
                       double *df) {
  rotors_t sum = {0.0, {0.0, 0.0, 0.0}, 0.0};
  const double I = r->rotor_inertia_kgm2, half_I_over_kf = 0.5 * I / r->kf_Ns2;
  for (int i = 0; i < ROTORS; i++) {
    const double scaled = r->thrust_scale[i] * f[i], lift = ratio[i] * scaled;
    df[i] = (r->command_N[i] - f[i]) * r->per_tau;
    sum.thrust_N += lift;
    sum.moment_b_Nm.x += r->rotor_at_m[i].y * lift;
    sum.moment_b_Nm.y -= r->rotor_at_m[i].x * lift;
    const double torque = r->torque_ratio_m * r->torque_scale[i] * scaled + half_I_over_kf * df[i] / speed[i];
    sum.spin_Nms += r->spin[i] * I * speed[i];
    sum.moment_b_Nm.z -= r->spin[i] * torque;
  }
  return sum;
}

static void translate(const rigid_t *r, const double *y, const axes_t *axes, d3_t force_b_N, double *dydt) {
  const d3_t acc = d3_scale(r->per_mass, axes_to_world(axes, force_b_N));
  dydt[RIGID_POS_M] = y[RIGID_VEL_MPS];
  dydt[RIGID_POS_M + 1] = y[RIGID_VEL_MPS + 1];
  dydt[RIGID_POS_M + 2] = y[RIGID_VEL_MPS + 2];
  dydt[RIGID_VEL_MPS] = acc.x;
  dydt[RIGID_VEL_MPS + 1] = acc.y;
  dydt[RIGID_VEL_MPS + 2] = acc.z - PLANT_GRAVITY_MPS2;
}

static void rotate(const rigid_t *r, const double *y, d3_t moment_b_Nm, double spin_Nms, double *dydt) {
  const d3_t w = d3_of(y + RIGID_RATE_RADPS), J = r->inertia_kgm2, per = r->per_inertia;
  const d3_t h = d3(J.x * w.x, J.y * w.y, J.z * w.z + spin_Nms);
  const d3_t left = d3_sub(moment_b_Nm, d3_cross(w, h));
  const double a = y[RIGID_Q_WB], b = y[RIGID_Q_WB + 1], c = y[RIGID_Q_WB + 2], d = y[RIGID_Q_WB + 3];
  dydt[RIGID_Q_WB] = -0.5 * (b * w.x + c * w.y + d * w.z);
  dydt[RIGID_Q_WB + 1] = 0.5 * (a * w.x + c * w.z - d * w.y);
  dydt[RIGID_Q_WB + 2] = 0.5 * (a * w.y + d * w.x - b * w.z);
  dydt[RIGID_Q_WB + 3] = 0.5 * (a * w.z + b * w.y - c * w.x);
  d3_put(dydt + RIGID_RATE_RADPS, d3(left.x * per.x, left.y * per.y, left.z * per.z));
}

void rigid_derivative(const rigid_t *r, const double y[RIGID_N], const axes_t *axes,
                      const double speed[ROTORS], const double ratio[ROTORS], const load_t *load,
                      double dydt[RIGID_N]) {
  const rotors_t sum = rotors(r, y + RIGID_THRUST_N, speed, ratio, dydt + RIGID_THRUST_N);
  const d3_t force = d3_add(load->force_b_N, d3(0.0, 0.0, sum.thrust_N));
  translate(r, y, axes, force, dydt);
  rotate(r, y, d3_add(load->moment_b_Nm, sum.moment_b_Nm), sum.spin_Nms, dydt);
  if (!r->vertical_only) return;
  for (int i = 0; i < RIGID_THRUST_N; i++)
    if (i != RIGID_POS_M + 2 && i != RIGID_VEL_MPS + 2) dydt[i] = 0.0;
}

void rigid_normalise(double y[RIGID_N]) {
  double *q = y + RIGID_Q_WB;
  const double scale = 1.0 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; i++) q[i] *= scale;
}

double rigid_energy_J(const rigid_t *r, const double y[RIGID_N]) {
  const d3_t v = d3_of(y + RIGID_VEL_MPS), w = d3_of(y + RIGID_RATE_RADPS), J = r->inertia_kgm2;
  return 0.5 * (r->mass_kg * d3_dot(v, v) + J.x * w.x * w.x + J.y * w.y * w.y + J.z * w.z * w.z);
}

d3_t rigid_momentum_w(const rigid_t *r, const double y[RIGID_N]) {
  const d3_t w = d3_of(y + RIGID_RATE_RADPS), J = r->inertia_kgm2;
  double spin_Nms = 0.0, speed[ROTORS];
  rigid_rotor_radps(r, y + RIGID_THRUST_N, speed);
  for (int i = 0; i < ROTORS; i++) spin_Nms += r->spin[i] * r->rotor_inertia_kgm2 * speed[i];
  const axes_t axes = axes_of(dq_of(y + RIGID_Q_WB));
  return axes_to_world(&axes, d3(J.x * w.x, J.y * w.y, J.z * w.z + spin_Nms));
}
