// crazyflie.c - a Crazyflie on the host.
#include "crazyflie.h"

#include "controller.h"
#include "log.h"
#include "stand_in.h"
#include "values.h"
#include <string.h>

// --- opening --------------------------------------------------------------------------------------------

// This project's stock PID in place of the firmware's. Like the firmware's, it keeps its last command in
// *control in the steps in which it does not run.
static void stock(void *context, control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                  const state_t *state, uint32_t step) {
  (void)sensors, (void)state;
  crazyflie_t *const c = context;
  pilot_in_t in = *c->now;
  in.step = step;
  if (setpoint->mode.z == modeDisable && setpoint->thrust == 0.0f)
    in.set = (pilot_setpoint_t){.mode = {PILOT_OFF, PILOT_OFF, PILOT_OFF}};
  const stock_command_t *const command = stock_pid_command(&c->stock, &in);
  control->controlMode = controlModeLegacy;
  control->thrust = (float)command->thrust;
  if (!RATE_DO_EXECUTE(ATTITUDE_RATE, step) && command->thrust != 0.0) return;
  control->roll = (int16_t)command->roll;
  control->pitch = (int16_t)command->pitch;
  control->yaw = (int16_t)command->yaw;
}

static void take_model(crazyflie_t *c, const model_t *model) {
  c->firmware = stock_power_legacy();
  c->compensates = true;
  c->map = (thrust_map_t){.kind = THRUST_MAP_VOLT_CUBIC};
  memcpy(c->map.c, c->firmware.volt_cubic, sizeof c->firmware.volt_cubic);
  if (model) {
    c->compensates = model->map.kind != THRUST_MAP_NONE;
    c->map = model->map;
    if (model->map.kind == THRUST_MAP_VOLT_CUBIC)
      memcpy(c->firmware.volt_cubic, model->map.c, sizeof c->firmware.volt_cubic);
    if (model->map.kind != THRUST_MAP_STAND) c->firmware.thrust_max_N = model->thrust_max_N / PILOT_MOTORS;
    if (!c->compensates) c->firmware.thrust_min_N = 0.0;
  }
  c->around.thrust_max_N = (float)c->firmware.thrust_max_N;
  for (int i = 0; i < STAND_IN_VOLT_N; i++) c->around.volt_N[i] = (float)c->firmware.volt_cubic[i];
  if (c->compensates) return;
  // A command is duty. The firmware does not know the thrust that results, so the map gives full thrust at
  // any voltage: none counts as too low.
  memset(c->around.volt_N, 0, sizeof c->around.volt_N);
  c->around.volt_N[0] = (float)c->firmware.thrust_max_N;
}

void crazyflie_init(crazyflie_t *c, const model_t *model) {
  *c = (crazyflie_t){.app = glue_static, .touched = true};
  c->around = (stand_in_t){
      .app = &c->app, .has_flow = true, .has_multiranger = true, .stock = stock, .stock_context = c};
  c->supervised_by = supervised_default;
  take_model(c, model);
  c->stock.param = stock_pid_default();
  c->stock.param.power = c->firmware;
}

void crazyflie_home(crazyflie_t *c) {
  if (c->bring_home) c->bring_home(c->home_context);
  c->touched = true; // once its state is here
}

void crazyflie_start(crazyflie_t *c) {
  crazyflie_home(c);
  stand_in = &c->around;
  memset(c->around.range_mm, 0, sizeof c->around.range_mm);
  c->around.can_fly = c->around.flying = c->around.motors_allowed = false;
  c->supervised = (supervised_t){.state = SUPERVISED_BEGIN};
  c->called = false;
  c->control = (control_t){.controlMode = controlModeLegacy};
  stock_power_start(&c->power);
  stock_pid_reset(&c->stock);
  controllerOutOfTreeInit();
  (void)controllerOutOfTreeTest();
}

// --- looking ----------------------------------------------------------------------------------------------

const void *crazyflie_at(const crazyflie_t *c, const void *address) {
  return stand_in_own(&c->around, address);
}

static void *own(const crazyflie_t *c, const void *address) {
  return stand_in_own(&c->around, address);
}

bool crazyflie_set(crazyflie_t *c, const char *name, double value) {
  const section_param_t *const p = sections_param(name);
  if (!p) return false;
  crazyflie_home(c);
  stand_in = &c->around;
  values_put(p->type, own(c, p->address), value);
  if (p->callback) p->callback();
  return true;
}

bool crazyflie_param(const crazyflie_t *c, const char *name, double *value) {
  const section_param_t *const p = sections_param(name);
  if (p) *value = values_of_param(p->type, own(c, p->address));
  return p != NULL;
}

bool crazyflie_log(const crazyflie_t *c, const char *name, double *value) {
  const section_log_t *const l = sections_log(name);
  if (l) *value = values_of_log(l->type, own(c, l->address));
  return l != NULL;
}

void crazyflie_logs(const crazyflie_t *c, float *value) {
  const section_log_group_t *const *group;
  const int n = sections_log_groups(&group);
  for (int g = 0; g < n; g++)
    for (const section_log_t *l = group[g]->log; l->name; l++, value++)
      if (l->type == LOG_FLOAT) // nearly all of them
        memcpy(value, own(c, l->address), sizeof *value);
      else
        *value = (float)values_of_log(l->type, own(c, l->address));
}
