// stock_table.c - the stock firmware's own parameters and logs.
#include "stock_table.h"

#include "log.h"
#include "param.h"

#include "stock_pid.h"

#define PARAM(group, name, c_type, type, ...)                                                                \
  {#group, #name, (type), offsetof(stock_params_t, group##_##name)},
#define LOG(group, name, c_type, type) {#group, #name, (type), offsetof(stock_logs_t, group##_##name)},
const stock_row_t stock_param_rows[] = {STOCK_PARAMS(PARAM)};
const stock_row_t stock_log_rows[] = {STOCK_LOGS(LOG)};
const int stock_param_count = (int)(sizeof stock_param_rows / sizeof *stock_param_rows);
const int stock_log_count = (int)(sizeof stock_log_rows / sizeof *stock_log_rows);

// Axes whose gains both table and stock PID have, in the same order. In the table each has three in a row.
#define GAIN_AXES 12

static const pid_gain_t *gain_of(const stock_pid_param_t *pid, int axis) {
  const pid_gain_t *const rows[] = {pid->attitude, pid->rate, pid->position.pos, pid->position.vel};
  return &rows[axis / 3][axis % 3];
}

static float *first_gain(stock_params_t *p) {
  return &p->pid_attitude_roll_kp;
}

_Static_assert(offsetof(stock_params_t, velCtlPid_vzKd) - offsetof(stock_params_t, pid_attitude_roll_kp) ==
                   (3 * GAIN_AXES - 1) * sizeof(float),
               "the gains follow each other");

static void show_gains(stock_params_t *p, const stock_pid_param_t *pid) {
  float *at = first_gain(p);
  for (int i = 0; i < GAIN_AXES; i++) {
    const pid_gain_t *const gain = gain_of(pid, i);
    *at++ = (float)gain->kp;
    *at++ = (float)gain->ki;
    *at++ = (float)gain->kd;
  }
}

void stock_params_take_gains(const stock_params_t *p, stock_pid_param_t *pid) {
  const float *at = &p->pid_attitude_roll_kp;
  for (int i = 0; i < GAIN_AXES; i++) {
    pid_gain_t *const gain = (pid_gain_t *)gain_of(pid, i);
    gain->kp = (double)*at++;
    gain->ki = (double)*at++;
    gain->kd = (double)*at++;
  }
}

stock_params_t stock_params_default(void) {
#define INITIAL(group, name, c_type, type, initial) .group##_##name = (initial),
  stock_params_t p = {STOCK_PARAMS(INITIAL)};
  const stock_pid_param_t pid = stock_pid_default();
  show_gains(&p, &pid);
  return p;
}
