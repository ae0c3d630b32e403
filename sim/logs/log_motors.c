// log_motors.c - what a log says of its motors, as newton of each in free air.
#include "logs/log_motors.h"

#include "base/lsq.h"
#include "plant/thrust_map.h"
#include <math.h>
#include <stdio.h>

#define PWM_MAX 65535.0

static const signals_t THRUST = SIGNAL_BIT(SIG_THRUST);
static const signals_t MOTORS =
    SIGNAL_BIT(SIG_M1) | SIGNAL_BIT(SIG_M2) | SIGNAL_BIT(SIG_M3) | SIGNAL_BIT(SIG_M4);
static const signals_t NEWTON =
    SIGNAL_BIT(SIG_F1) | SIGNAL_BIT(SIG_F2) | SIGNAL_BIT(SIG_F3) | SIGNAL_BIT(SIG_F4);
static const signals_t TORQUES = SIGNAL_BIT(SIG_TX) | SIGNAL_BIT(SIG_TY) | SIGNAL_BIT(SIG_TZ);

// Inverts the map from the rotors' forces to thrust and torques.
static void unmix(log_motors_t *m, const frame_t *f) {
  double A[4][ROTORS];
  for (int i = 0; i < ROTORS; i++) {
    A[0][i] = 1.0;
    A[1][i] = f->rotor_y_m[i];
    A[2][i] = -f->rotor_x_m[i];
    A[3][i] = -f->rotor_spin[i] * f->torque_ratio_m;
  }
  for (int k = 0; k < 4; k++) {
    double unit[4] = {0.0}, x[ROTORS];
    unit[k] = 1.0;
    lsq_solve(4, ROTORS, &A[0][0], unit, x);
    for (int i = 0; i < ROTORS; i++) m->unmix[i][k] = x[i];
  }
}

// Writes why the vehicle's map cannot convert the commands to newton; empty: it can.
static void map_lacks(const columns_t *c, const model_t *vehicle, bool speed, signals_t has,
                      char text[LOG_MOTORS_LACKS]) {
  const thrust_map_t *const map = &vehicle->map;
  if (map->kind == THRUST_MAP_NONE) {
    snprintf(text, LOG_MOTORS_LACKS,
             "a motor command, but vehicle %s has no [thrust_map]; choose one that has (--vehicle)",
             vehicle->name);
    return;
  }
  if (thrust_map_takes_speed(map) != speed) {
    snprintf(text, LOG_MOTORS_LACKS, "a command in %s, but the [thrust_map] of vehicle %s takes %s",
             speed ? "rad/s" : "pwm", vehicle->name, speed ? "pwm" : "rad/s");
    return;
  }
  if (!thrust_map_needs_voltage(map) || (has & SIGNAL_BIT(SIG_VBAT))) return;
  const char *const vbat = c->of[SIG_VBAT].column;
  snprintf(text, LOG_MOTORS_LACKS,
           "column %s: missing; the motor commands are there, and the thrust map needs the battery's voltage "
           "beside them",
           vbat[0] ? vbat : "for vbat");
}

static log_motors_kind_t kind_of(const columns_t *c, signals_t has) {
  const bool thrust = has & THRUST, mix = thrust && (has & TORQUES) == TORQUES;
  if ((has & MOTORS) == MOTORS) return c->motors == MOTORS_N ? LOG_MOTORS_EACH : LOG_MOTORS_MAP;
  if (mix) return c->mixed_pwm ? LOG_MOTORS_MIX_PWM : LOG_MOTORS_MIX;
  if (thrust) return c->mixed_pwm ? LOG_MOTORS_TOTAL_PWM : LOG_MOTORS_TOTAL;
  return LOG_MOTORS_NONE;
}

void log_motors_init(log_motors_t *m, const columns_t *columns, const model_t *vehicle, signals_t *has,
                     char lacks[LOG_MOTORS_LACKS]) {
  *m = (log_motors_t){.kind = kind_of(columns, *has), .total_logged = *has & THRUST && !columns->mixed_pwm};
  const bool by_map =
      m->kind == LOG_MOTORS_MAP || m->kind == LOG_MOTORS_MIX_PWM || m->kind == LOG_MOTORS_TOTAL_PWM;
  const bool speed = m->kind == LOG_MOTORS_MAP && columns->motors == MOTORS_RADPS;
  lacks[0] = '\0';
  if (by_map) map_lacks(columns, vehicle, speed, *has, lacks);
  if (m->kind == LOG_MOTORS_MIX_PWM) *has |= MOTORS;
  if (lacks[0]) {
    if (columns->mixed_pwm) *has &= ~THRUST;
    if (m->kind != LOG_MOTORS_MIX_PWM) m->kind = m->total_logged ? LOG_MOTORS_TOTAL : LOG_MOTORS_NONE;
    if (m->total_logged) lacks[0] = '\0';
    return;
  }
  if (m->kind == LOG_MOTORS_MIX) unmix(m, &vehicle->frame);
  if (m->kind != LOG_MOTORS_NONE) *has |= THRUST;
  if (m->kind >= LOG_MOTORS_EACH) *has |= NEWTON;
}

// Returns newton by the map, and NaN for a gap, which the map's lower bound would hide.
static double map_N(const model_t *vehicle, double command, double vbat_V) {
  if (isnan(command) || (thrust_map_needs_voltage(&vehicle->map) && isnan(vbat_V))) return (double)NAN;
  return thrust_map_N(&vehicle->map, command, vbat_V);
}

// The firmware's mixer (power_distribution_quadrotor.c), which cuts off at its limits.
static void mix_pwm(double *v) {
  static const double sign[ROTORS][3] = {
      {-0.5, 0.5, 1.0}, {-0.5, -0.5, -1.0}, {0.5, -0.5, 1.0}, {0.5, 0.5, -1.0}};
  for (int i = 0; i < ROTORS; i++) {
    const double pwm =
        v[SIG_THRUST] + sign[i][0] * v[SIG_TX] + sign[i][1] * v[SIG_TY] + sign[i][2] * v[SIG_TZ];
    v[SIG_M1 + i] = isnan(pwm) ? pwm : fmin(fmax(pwm, 0.0), PWM_MAX);
  }
}

static void fill_newton(const log_motors_t *m, const model_t *vehicle, double *v) {
  const double asked[4] = {v[SIG_THRUST], v[SIG_TX], v[SIG_TY], v[SIG_TZ]};
  for (int i = 0; i < ROTORS; i++) {
    double *const f = &v[SIG_F1 + i];
    if (m->kind == LOG_MOTORS_EACH) *f = v[SIG_M1 + i];
    if (m->kind == LOG_MOTORS_MAP || m->kind == LOG_MOTORS_MIX_PWM)
      *f = map_N(vehicle, v[SIG_M1 + i], v[SIG_VBAT]);
    if (m->kind != LOG_MOTORS_MIX) continue;
    *f = 0.0;
    for (int k = 0; k < 4; k++) *f += m->unmix[i][k] * asked[k];
    *f = isnan(*f) ? *f : fmax(*f, fmin(vehicle->thrust_min_N / ROTORS, 0.0)); // as the plant
  }
}

bool log_motors_fill(const log_motors_t *m, const columns_t *columns, const model_t *vehicle,
                     double v[SIG_COUNT]) {
  bool at_limit = false;
  if (m->kind == LOG_MOTORS_MIX_PWM) mix_pwm(v);
  if (m->kind == LOG_MOTORS_TOTAL_PWM) {
    at_limit = v[SIG_THRUST] >= PWM_MAX;
    v[SIG_THRUST] = 4.0 * map_N(vehicle, v[SIG_THRUST], v[SIG_VBAT]);
  }
  if (m->kind >= LOG_MOTORS_EACH) fill_newton(m, vehicle, v);
  if (m->kind >= LOG_MOTORS_EACH && !m->total_logged)
    v[SIG_THRUST] = v[SIG_F1] + v[SIG_F2] + v[SIG_F3] + v[SIG_F4];
  // A command of zero is not at a limit: the thrust that it gives is known.
  const bool pwm =
      m->kind == LOG_MOTORS_MIX_PWM || (m->kind == LOG_MOTORS_MAP && columns->motors == MOTORS_PWM);
  for (int i = 0; i < ROTORS && m->kind >= LOG_MOTORS_EACH; i++)
    at_limit = at_limit || (pwm ? v[SIG_M1 + i] >= PWM_MAX : v[SIG_F1 + i] >= 0.25 * vehicle->thrust_max_N);
  return at_limit || (m->total_logged && v[SIG_THRUST] >= vehicle->thrust_max_N);
}
