// vehicle6.c - a vehicle with six degrees of freedom for tests.
#include "rig/vehicle6.h"

const integrate_kind_t vehicle6_kinds[2] = {INTEGRATE_SUNDIALS, INTEGRATE_RK4};

model_t vehicle6(double ceiling_m) {
  model_t m = {.name = "test",
               .mass_kg = MASS_KG,
               .rotor_radius_m = RADIUS_M,
               .motor_tau_s = 0.0625,
               .thrust_max_N = 0.6,
               .ceiling_m = ceiling_m};
  m.frame = model_frame_like_crazyflie(&m);
  for (int i = 0; i < ROTORS; i++) {
    m.frame.rotor_x_m[i] = i == 0 || i == 3 ? 0.0325 : -0.0325;
    m.frame.rotor_y_m[i] = i < 2 ? -0.0325 : 0.0325;
  }
  m.frame.inertia_kgm2[0] = m.frame.inertia_kgm2[1] = 16.8e-6;
  m.frame.inertia_kgm2[2] = 29.8e-6;
  m.frame.top_above_rotor_m = -0.005;
  return m;
}

fx_use_t *vehicle6_add(model_t *m, const char *effect) {
  why_t why;
  const fx_use_t use = fx_use(fx_find(effect));
  CHECK_OK(model_add_fx(m, &use, &why));
  return &m->fx[m->n_fx - 1];
}

body_start_t vehicle6_start(const model_t *m, double rotor_z_m, double share) {
  const double f = share * WEIGHT_N / ROTORS;
  return (body_start_t){.pos_w_m = {0.0, 0.0, rotor_z_m - body_rotor_z_m(m)}, .thrust_N = {f, f, f, f}};
}

void vehicle6_fly(body_t *b, double share, int ticks) {
  const double f = share * WEIGHT_N / ROTORS, command_N[ROTORS] = {f, f, f, f};
  for (int i = 0; i < ticks; i++) body_tick(b, command_N, TICK_S);
}

double vehicle6_tilt_rad(const body_t *b) {
  const axes_t axes = axes_of(dq_of(b->y + RIGID_Q_WB));
  return acos(fmin(1.0, axes.z.z));
}
