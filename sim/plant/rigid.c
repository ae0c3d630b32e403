// rigid.c - a rigid body with four rotors.
#include "plant/rigid.h"

#include <string.h>

void rigid_tune(rigid_t *r) {
  r->per_mass = 1.0 / r->mass_kg;
  const lag_t lag = rigid_lag(r);
  r->per_tau = lag_is_none(&lag) ? 0.0 : 1.0 / lag.up_s;
  r->per_tau_down = lag_is_none(&lag) ? 0.0 : 1.0 / lag.down_s;
  r->plain_lag = !lag.in_speed && lag.down_s == lag.up_s;
  r->per_root_kf = 1.0 / sqrt(r->kf_Ns2);
  r->per_two_steady = r->lag_steady_N > 0.0 ? 0.5 / (sqrt(r->lag_steady_N) * r->per_root_kf) : 0.0;
  r->half_I_per_kf = 0.5 * r->rotor_inertia_kgm2 / r->kf_Ns2;
  r->per_inertia = d3(1.0 / r->inertia_kgm2.x, 1.0 / r->inertia_kgm2.y, 1.0 / r->inertia_kgm2.z);
}

lag_t rigid_lag(const rigid_t *r) {
  const double down_over_up = r->motor_down_over_up > 0.0 ? r->motor_down_over_up : 1.0;
  return (lag_t){r->motor_tau_s,     r->motor_tau_s * down_over_up,
                 r->lag_in_speed,    r->lag_up_square,
                 r->lag_down_square, r->lag_steady_N};
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
