// model.c - numbers and effects of a model.
#include "vehicle/model.h"

#include <math.h>
#include <string.h>

// Crazyflie 2.1 with legacy propellers, decks on: the sources stand in vehicles/cf21_legacy.toml.
#define CF_MASS_KG  0.0329
#define CF_RADIUS_M 0.02355
#define LIGHTEST    0.1 // share of the vehicle's mass; with less left, no integrator step is short enough

frame_t model_frame_like_crazyflie(const model_t *m) {
  const double size = m->rotor_radius_m / CF_RADIUS_M, weight = m->mass_kg / CF_MASS_KG;
  const double inertia = weight * size * size, arm_m = 0.03253 * size;
  return (frame_t){
      .inertia_kgm2 = {16.8e-6 * inertia, 16.8e-6 * inertia, 29.8e-6 * inertia},
      .rotor_x_m = {arm_m, -arm_m, -arm_m, arm_m},
      .rotor_y_m = {-arm_m, -arm_m, arm_m, arm_m},
      .rotor_spin = {1.0, -1.0, 1.0, -1.0},
      .torque_ratio_m = 0.00735 * size,
      .kf_Ns2 = 2.0e-8 * size * size * size * size,
      .rotor_inertia_kgm2 = 34.52e-9 * inertia,
      .cg_above_feet_m = 0.017 * size,
      .rotor_above_feet_m = 0.030 * size,
      .top_above_rotor_m = 0.008 * size,
      .top_half_m = 0.015 * size,
  };
}

static double per_square(double square) {
  return square > 0.0 ? 1.0 / square : 0.0;
}

void model_mix(const frame_t *f, double lift_N, const double moment_Nm[3], double more_N[ROTORS]) {
  double xx = 0.0, yy = 0.0;
  for (int k = 0; k < ROTORS; k++) {
    xx += f->rotor_x_m[k] * f->rotor_x_m[k];
    yy += f->rotor_y_m[k] * f->rotor_y_m[k];
  }
  const double roll = moment_Nm[0] * per_square(yy), pitch = moment_Nm[1] * per_square(xx);
  const double yaw = f->torque_ratio_m > 0.0 ? moment_Nm[2] / (ROTORS * f->torque_ratio_m) : 0.0;
  for (int k = 0; k < ROTORS; k++)
    more_N[k] = lift_N / ROTORS + roll * f->rotor_y_m[k] - pitch * f->rotor_x_m[k] - yaw * f->rotor_spin[k];
}

model_t model_point(const model_t *m) {
  model_t point = *m;
  point.frame = model_frame_like_crazyflie(m);
  point.frame.cg_above_feet_m = point.frame.rotor_above_feet_m = point.frame.top_above_rotor_m = 0.0;
  point.wall_y_m = HUGE_VAL;
  point.wall_solid = false;
  point.floor_rise_x = point.floor_rise_y = 0.0;
  point.battery = (battery_param_t){0};
  return point;
}

double model_steady_N(const model_t *m) {
  return m->mass_kg * G_MPS2 / ROTORS;
}

lag_t model_lag(const model_t *m, double more_s) {
  const double up_s = fmax(m->motor_tau_s + more_s, 0.0);
  return (lag_t){.up_s = up_s,
                 .down_s = up_s * (m->motor_down_over_up > 0.0 ? m->motor_down_over_up : 1.0),
                 .in_speed = m->lag_in_speed,
                 .up_square = m->lag_square[0],
                 .down_square = m->lag_square[1],
                 .steady_N = model_steady_N(m)};
}

double model_step_s(const model_t *m, double most_s) {
  const lag_t lag = model_lag(m, 0.0);
  if (lag_is_none(&lag)) return most_s;
  const double faster = sqrt(fmax(m->thrust_max_N / ROTORS / lag.steady_N, 1.0)) - 1.0; // relative to hover
  const double up_s = lag.up_s / (1.0 + lag.up_square * faster),
               down_s = lag.down_s / (1.0 + lag.down_square * faster);
  return fmin(most_s, 0.5 * fmin(up_s, down_s));
}

double model_grows(const model_t *m, fx_grows_t how) {
  static const model_t crazyflie = {.mass_kg = CF_MASS_KG, .rotor_radius_m = CF_RADIUS_M};
  const frame_t own = m->frame, like = model_frame_like_crazyflie(&crazyflie);
  const double mass = m->mass_kg / CF_MASS_KG, inertia = own.inertia_kgm2[0] / like.inertia_kgm2[0];
  const double speed = sqrt(mass * like.kf_Ns2 / own.kf_Ns2); // of a rotor in hover
  switch (how) {
  case FX_BY_MASS: return mass;
  case FX_BY_MASS_PER_SPEED: return mass / speed;
  case FX_BY_INERTIA: return inertia;
  case FX_BY_INERTIA_PER_SPEED: return inertia / speed;
  case FX_BY_ARM:
    return hypot(own.rotor_x_m[0], own.rotor_y_m[0]) / hypot(like.rotor_x_m[0], like.rotor_y_m[0]);
  case FX_BY_PER_WEIGHT: return 1.0 / mass;
  default: return 1.0;
  }
}

double model_fx_least(const model_t *m, const fx_use_t *use, int param) {
  int n;
  const double least = fx_use_params(use, &n)[param].min;
  return use->fx == fx_find("mass") && param == 0 ? fmax(least, (LIGHTEST - 1.0) * m->mass_kg) : least;
}

static done_t check_mass(const model_t *m, const fx_use_t *use, why_t *why) {
  const double least_kg = model_fx_least(m, use, 0);
  if (use->fx != fx_find("mass") || use->p[0] >= least_kg) return DONE;
  return error_set(why, "effect mass: add = %g kg to a vehicle of %g kg; allowed: %.3g or more", use->p[0],
                   m->mass_kg, least_kg);
}

done_t model_add_fx(model_t *m, const fx_use_t *use, why_t *why) {
  TRY(check_mass(m, use, why));
  for (int i = 0; i < m->n_fx; i++) {
    if (m->fx[i].fx != use->fx) continue;
    m->fx[i] = *use;
    return DONE;
  }
  if (m->n_fx == FX_MAX)
    return error_set(why, "effect %s: at most %d effects at once", use->fx->name, FX_MAX);
  m->fx[m->n_fx++] = *use;
  return DONE;
}

d3_t model_floor_up_w(const model_t *m) {
  const d3_t up = d3(0.0 - m->floor_rise_x, 0.0 - m->floor_rise_y, 1.0); // no -0 where it is level
  return d3_scale(1.0 / d3_norm(up), up);
}

const fx_use_t *model_fx(const model_t *m, const fx_t *fx) {
  for (int i = 0; i < m->n_fx; i++)
    if (m->fx[i].fx == fx) return &m->fx[i];
  return NULL;
}

void model_drop_fx(model_t *m, const fx_t *fx) {
  for (int i = 0; i < m->n_fx; i++) {
    if (m->fx[i].fx != fx) continue;
    m->fx[i] = m->fx[--m->n_fx];
    return;
  }
}

double model_thrust_ratio(const model_t *m, const fx_place_t *place) {
  double ratio = 1.0;
  for (int i = 0; i < m->n_fx; i++)
    if (m->fx[i].fx->excess) ratio += m->fx[i].fx->excess(&m->fx[i], place);
  return ratio;
}

void model_sense(const model_t *m, fx_sensed_t *sensed) {
  for (int i = 0; i < m->n_fx; i++)
    if (m->fx[i].fx->sense) m->fx[i].fx->sense(&m->fx[i], sensed);
}
