// stock_pid.c - the Crazyflie firmware's cascaded PID controller.
#include "crazyflie/stock_pid.h"

#include "base/clip.h"
#include "base/constants.h"

#define COMMAND_MAX 32767.0

stock_pid_param_t stock_pid_default(void) {
  // kp, ki, kd, limit of the integral; no limit of the output, no filter
  const pid_gain_t tilt = {6.0, 3.0, 0.0, 20.0, 0.0, 0.0};
  const pid_gain_t yaw = {6.0, 1.0, 0.35, 360.0, 0.0, 0.0};
  const pid_gain_t tilt_rate = {250.0, 500.0, 2.5, 33.3, 0.0, 0.0};
  const pid_gain_t yaw_rate = {120.0, 16.7, 0.0, 166.7, 0.0, 0.0};
  return (stock_pid_param_t){
      .position = stock_position_default(),
      .attitude = {tilt, tilt, yaw},
      .rate = {tilt_rate, tilt_rate, yaw_rate},
      .power = stock_power_legacy(),
  };
}

void stock_pid_reset(stock_pid_t *s) {
  *s = (stock_pid_t){.param = s->param};
  stock_position_start(&s->position, &s->param.position, (d3_t){0.0, 0.0, 0.0});
  for (int i = 0; i < 3; i++) {
    pid_block_start(&s->attitude[i], &s->param.attitude[i], STOCK_ATTITUDE_HZ, 0.0);
    pid_block_start(&s->rate[i], &s->param.rate[i], STOCK_ATTITUDE_HZ, 0.0);
  }
  stock_power_start(&s->power);
}

static void start_anew(stock_pid_t *s, const pilot_in_t *in, const stock_view_t *view) {
  const double angle_deg[3] = {view->roll_deg, view->pitch_deg, view->yaw_deg};
  stock_position_start(&s->position, &s->param.position, in->pos_w_m);
  for (int i = 0; i < 3; i++) {
    pid_block_reset(&s->attitude[i], angle_deg[i]);
    pid_block_reset(&s->rate[i], 0.0);
  }
  s->wanted.roll_deg = view->roll_deg;
  s->wanted.pitch_deg = view->pitch_deg;
}

static bool mode_changed(stock_pid_t *s, const pilot_setpoint_t *set) {
  bool changed = set->yaw_by_rate != s->last.yaw_by_rate;
  for (int i = 0; i < 3; i++) changed |= set->mode[i] != s->last.mode[i];
  s->last = *set;
  return changed;
}

static void turn(stock_pid_t *s, const pilot_setpoint_t *set) {
  const double to_deg = set->yaw_by_rate ? s->yaw_deg + STOCK_DEG * set->yaw_rate_radps / STOCK_ATTITUDE_HZ
                                         : STOCK_DEG * set->yaw_rad;
  s->yaw_deg = stock_cap_deg(to_deg);
}

static double saturated(double command) {
  return clip(command, -COMMAND_MAX, COMMAND_MAX);
}

static void hold_attitude(stock_pid_t *s, const pilot_setpoint_t *set, const stock_view_t *view) {
  const bool level = set->mode[0] == PILOT_OFF || set->mode[1] == PILOT_OFF;
  const double wanted_deg[3] = {level ? STOCK_DEG * set->roll_rad : s->wanted.roll_deg,
                                level ? STOCK_DEG * set->pitch_up_rad : s->wanted.pitch_deg, s->yaw_deg};
  const double angle_deg[3] = {view->roll_deg, view->pitch_deg, view->yaw_deg};
  const double rate_dps[3] = {view->gyro_dps.x, -view->gyro_dps.y, view->gyro_dps.z};
  double command[3];
  for (int i = 0; i < 3; i++) {
    s->rate_dps[i] = pid_block_step(&s->attitude[i], &s->param.attitude[i], STOCK_ATTITUDE_HZ, wanted_deg[i],
                                    angle_deg[i], i == 2);
    command[i] = trunc(saturated(pid_block_step(&s->rate[i], &s->param.rate[i], STOCK_ATTITUDE_HZ,
                                                s->rate_dps[i], rate_dps[i], false)));
  }
  s->command.roll = command[0];
  s->command.pitch = command[1];
  s->command.yaw = -command[2];
}

const stock_command_t *stock_pid_command(stock_pid_t *s, const pilot_in_t *in) {
  const stock_view_t view = stock_view(in);
  if (mode_changed(s, &in->set)) start_anew(s, in, &view);
  const bool attitude_turn = in->step % STOCK_ATTITUDE_STEP == 0;
  if (attitude_turn) turn(s, &in->set);
  if (in->step % STOCK_POSITION_STEP == 0)
    s->wanted = stock_position_step(&s->position, &s->param.position, in, view.yaw_deg);
  if (attitude_turn) {
    if (in->set.mode[2] == PILOT_OFF)
      s->wanted.thrust = STOCK_FULL * in->set.thrust_N / (PILOT_MOTORS * s->param.power.thrust_max_N);
    hold_attitude(s, &in->set, &view);
    s->gyro_dps = view.gyro_dps;
    s->acc_z_g = in->acc_b_mps2.z / G_MPS2;
  }
  s->command.thrust = s->wanted.thrust;
  if (s->command.thrust == 0.0) {
    s->command = (stock_command_t){.thrust = 0.0};
    start_anew(s, in, &view);
    s->yaw_deg = view.yaw_deg;
  }
  return &s->command;
}

static void step(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  stock_pid_t *const s = state;
  double unit[PILOT_MOTORS];
  stock_mix(stock_pid_command(s, in), unit);
  stock_power_step(&s->power, &s->param.power, unit, in->vbat_V, motor_N);
}

static void reset(void *state) {
  stock_pid_reset(state);
}

pilot_t stock_pid_pilot(stock_pid_t *s, const stock_pid_param_t *param) {
  s->param = *param;
  stock_pid_reset(s);
  return (pilot_t){.state = s, .step = step, .reset = reset};
}
