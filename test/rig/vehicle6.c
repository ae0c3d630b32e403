// vehicle6.c - a vehicle with six degrees of freedom for tests.
#include "rig/vehicle6.h"

#include "plant/rotor.h"

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

void vehicle6_tick_pwm(body_t *b, const double pwm[ROTORS], double span_s) {
  double command_N[ROTORS];
  for (int i = 0; i < ROTORS; i++)
    command_N[i] = rotor_command_N(&b->model->map, pwm[i], b->vbat_V, b->model->thrust_max_N / ROTORS);
  body_tick(b, command_N, span_s);
}

d3_t vehicle6_angular_acc_b_radps2(const body_t *b) {
  double dydt[RIGID_N];
  body_derivative_seen(b, b->y, &b->look, dydt);
  return d3_of(dydt + RIGID_RATE_RADPS);
}

d3_t vehicle6_momentum_w(const rigid_t *r, const double y[RIGID_N]) {
  const d3_t w = d3_of(y + RIGID_RATE_RADPS), J = r->inertia_kgm2;
  double spin_Nms = 0.0, speed[ROTORS];
  rigid_rotor_radps(r, y + RIGID_THRUST_N, speed);
  for (int i = 0; i < ROTORS; i++) spin_Nms += r->spin[i] * r->rotor_inertia_kgm2 * speed[i];
  const axes_t axes = axes_of(dq_of(y + RIGID_Q_WB));
  return axes_to_world(&axes, d3(J.x * w.x, J.y * w.y, J.z * w.z + spin_Nms));
}
