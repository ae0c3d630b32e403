// air_garage.c - the air garage's thrust division around the stock PID.
#include "pilots/air_garage.h"

#include "base/clip.h"

#define ARM_M 0.032

air_garage_param_t air_garage_2024(void) {
  air_garage_param_t p = {
      .pid = stock_pid_default(),
      .how = AIR_GARAGE_TOTAL,
      .ceiling_m = HUGE_VAL,
      .ground_m = -HUGE_VAL,
      .radius_m = 0.023,
      .ahead_m = {ARM_M, ARM_M, -ARM_M, -ARM_M},
      .left_m = {ARM_M, -ARM_M, -ARM_M, ARM_M},
      .near_R = 0.5,
      .near_ceiling = 1.11,
      .near_ground = 2.0,
  };
  p.pid.power = stock_power_60g();
  return p;
}

air_garage_param_t air_garage_2025(void) {
  air_garage_param_t p = air_garage_2024();
  p.how = AIR_GARAGE_PER_ROTOR;
  p.near_R = 0.0;
  return p;
}

static bool is_near(const air_garage_param_t *p, double distance_m) {
  return p->near_R > 0.0 && distance_m <= p->near_R * p->radius_m;
}

double air_garage_ceiling_ratio(const air_garage_param_t *p, double distance_m) {
  const double k = p->radius_m / distance_m;
  return is_near(p, distance_m) ? p->near_ceiling : 0.5 + 0.5 * sqrt(1.0 + k * k / 8.0);
}

double air_garage_ground_ratio(const air_garage_param_t *p, double distance_m) {
  const double k = p->radius_m / (4.0 * distance_m);
  return is_near(p, distance_m) ? p->near_ground : 1.0 / (1.0 - k * k);
}

static double ratio_at(const air_garage_param_t *p, double z_m) {
  return air_garage_ceiling_ratio(p, p->ceiling_m - z_m) * air_garage_ground_ratio(p, z_m - p->ground_m);
}

// The square root of the ratio at rotor i; NaN below the pole of the ground formula.
static double rotor_root(const air_garage_param_t *p, const pilot_in_t *in, int i) {
  const d3_t at = dq_to_world(in->q_wb, (d3_t){p->ahead_m[i], p->left_m[i], 0.0});
  return sqrt(ratio_at(p, in->pos_w_m.z + at.z));
}

static void step(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  air_garage_t *const s = state;
  const air_garage_param_t *p = &s->param;
  stock_command_t command = *stock_pid_command(&s->pid, in);
  if (p->how == AIR_GARAGE_TOTAL) command.thrust /= ratio_at(p, in->pos_w_m.z);
  double unit[PILOT_MOTORS];
  stock_mix(&command, unit);
  for (int i = 0; i < PILOT_MOTORS; i++) {
    if (p->how == AIR_GARAGE_PER_ROTOR) unit[i] /= rotor_root(p, in, i);
    unit[i] = clip(unit[i], 0.0, STOCK_FULL); // NaN becomes 0
  }
  stock_power_step(&s->pid.power, &s->pid.param.power, unit, in->vbat_V, motor_N);
}

static void reset(void *state) {
  air_garage_t *const s = state;
  stock_pid_reset(&s->pid);
}

pilot_t air_garage_pilot(air_garage_t *s, const air_garage_param_t *param) {
  s->param = *param;
  s->pid.param = param->pid;
  reset(s);
  return (pilot_t){.state = s, .step = step, .reset = reset};
}
