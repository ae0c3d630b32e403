// stock_indi.c - the Crazyflie firmware's own INDI.
#include "crazyflie/stock_indi.h"

#include "base/clip.h"

enum { ROLL, PITCH, YAW };

stock_indi_param_t stock_indi_default(void) {
  return (stock_indi_param_t){
      .position = stock_indi_outer_default(),
      .cascade = stock_position_default(),
      .outer = true,
      .g1 = {0.0066146, 0.0052125, 0.001497},
      .g2 = 0.000043475,
      .angle_per_s = 5.0,
      .rate_per_s = 24.0,
      .lag_gain = 0.03149,
      .cutoff_Hz = 8.0,
      .thrust_min = 300.0,
      .command_max = 32000.0,
      .power = stock_power_legacy(),
  };
}

void stock_indi_select(stock_indi_t *s) {
  for (int i = 0; i < 3; i++) {
    s->u_lagged[i] = s->u_in[i] = 0.0;
    lowpass_init(&s->rate[i], s->param.cutoff_Hz, STOCK_ATTITUDE_HZ, 0.0);
    lowpass_init(&s->u[i], s->param.cutoff_Hz, STOCK_ATTITUDE_HZ, 0.0);
  }
  stock_position_start(&s->cascade, &s->param.cascade, (d3_t){0.0, 0.0, 0.0});
  stock_indi_outer_select(&s->position, &s->param.position);
}

// Fault 1: the wanted yaw is in radians already when the next tick adds to it and converts it again. A
// heading is converted to north-east-down, a rate is not.
static void turn(stock_indi_t *s, const pilot_setpoint_t *set) {
  const double rate_dps = STOCK_DEG * set->yaw_rate_radps;
  s->angle_rad[YAW] = set->yaw_by_rate
                          ? stock_cap_deg(s->angle_rad[YAW] + rate_dps / STOCK_ATTITUDE_HZ) / STOCK_DEG
                          : -stock_cap_deg(STOCK_DEG * set->yaw_rad) / STOCK_DEG;
}

// Fault 4: puts degrees where radians are expected.
static void run_cascade(stock_indi_t *s, const pilot_in_t *in, const stock_view_t *view) {
  const stock_position_out_t wanted = stock_position_step(&s->cascade, &s->param.cascade, in, view->yaw_deg);
  s->angle_rad[ROLL] = wanted.roll_deg;
  s->angle_rad[PITCH] = wanted.pitch_deg;
  s->thrust = wanted.thrust;
}

static void run_position(stock_indi_t *s, const pilot_in_t *in, const stock_view_t *view) {
  const pilot_mode_t *const mode = in->set.mode;
  // The position loop runs even when none of its outputs is used (fault 5).
  if (s->param.outer) {
    stock_indi_outer_step(&s->position, &s->param.position, in, view);
    s->thrust = s->position.thrust;
    s->angle_rad[ROLL] = s->position.roll_rad;
    s->angle_rad[PITCH] = s->position.pitch_rad;
  }
  if (mode[2] == PILOT_OFF)
    s->thrust = STOCK_FULL * in->set.thrust_N / (PILOT_MOTORS * s->param.power.thrust_max_N);
  // Wanted roll depends on the mode of x, pitch on that of y.
  if (mode[0] == PILOT_OFF) s->angle_rad[ROLL] = in->set.roll_rad;
  if (mode[1] == PILOT_OFF) s->angle_rad[PITCH] = in->set.pitch_up_rad;
}

static void increment(stock_indi_t *s, int axis, double angle_rad, double rate_radps) {
  const stock_indi_param_t *p = &s->param;
  // The error is not wrapped, not even that of yaw (fault 2).
  const double rate_ref = p->angle_per_s * (s->angle_rad[axis] - angle_rad);
  const double before = s->rate[axis].y1;
  const double slope = STOCK_ATTITUDE_HZ * (lowpass_step(&s->rate[axis], rate_radps) - before);
  const double u = lowpass_step(&s->u[axis], s->u_lagged[axis]);
  const double error = p->rate_per_s * (rate_ref - rate_radps) - slope;
  double du = error / p->g1[axis];
  if (axis == YAW) du = s->du_yaw = (error + p->g2 * s->du_yaw) / (p->g1[axis] + p->g2);
  s->u_in[axis] = clip(u + du, -p->command_max, p->command_max);
  s->u_lagged[axis] += p->lag_gain * (s->u_in[axis] - s->u_lagged[axis]);
}

static void run_attitude(stock_indi_t *s, const stock_view_t *view) {
  const double k = 1.0 / STOCK_DEG;
  increment(s, ROLL, k * view->roll_deg, k * view->gyro_dps.x);
  increment(s, PITCH, k * view->pitch_deg, -k * view->gyro_dps.y);
  increment(s, YAW, -k * view->yaw_deg, -k * view->gyro_dps.z);
}

void stock_indi_step(stock_indi_t *s, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  const stock_view_t view = stock_view(in);
  const bool attitude_turn = in->step % STOCK_ATTITUDE_STEP == 0;
  if (attitude_turn) turn(s, &in->set);
  if (!s->param.outer && in->step % STOCK_POSITION_STEP == 0) run_cascade(s, in, &view);
  if (attitude_turn) {
    run_position(s, in, &view);
    run_attitude(s, &view);
  }
  if (s->thrust < s->param.thrust_min) {
    for (int i = 0; i < 3; i++) s->u_lagged[i] = s->u_in[i] = 0.0;
    // Degrees again. Only a yaw rate could show them, and with one fault 1 takes the wanted yaw to 0.
    if (s->thrust == 0.0) s->angle_rad[YAW] = -view.yaw_deg;
  }
  s->command = (stock_command_t){s->thrust, s->u_in[ROLL], s->u_in[PITCH], s->u_in[YAW]};
  double unit[PILOT_MOTORS];
  stock_mix(&s->command, unit);
  stock_power_step(&s->power, &s->param.power, unit, in->vbat_V, motor_N);
}

static void step(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  stock_indi_step(state, in, motor_N);
}

static void reset(void *state) {
  stock_indi_t *const s = state;
  *s = (stock_indi_t){.param = s->param};
  stock_indi_select(s);
  stock_power_start(&s->power);
}

pilot_t stock_indi_pilot(stock_indi_t *s, const stock_indi_param_t *param) {
  s->param = *param;
  reset(s);
  return (pilot_t){.state = s, .step = step, .reset = reset};
}
