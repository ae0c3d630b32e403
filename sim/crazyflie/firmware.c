// firmware.c - the firmware around the app.
#include "firmware.h"

#include "app.h"
#include "base/constants.h"
#include "controller.h"
#include "range.h"
#include "sections.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

uint32_t firmware_now_ms(const firmware_t *f) {
  return f->vehicle.around.clock_ms;
}

enum { INFO_PLANNED = 1 << 8, INFO_FINISHED = 1 << 9, INFO_DISABLED = 1 << 10 };

uint16_t firmware_info(const firmware_t *f) {
  const planner_t *const p = &f->commanded.planner;
  unsigned info = supervised_info(&f->vehicle.supervised);
  if (planner_active(p)) info |= INFO_PLANNED;
  if (planner_finished(p, firmware_now_ms(f))) info |= INFO_FINISHED;
  if (p->state == PLANNER_DISABLED) info |= INFO_DISABLED;
  return (uint16_t)info;
}

// --- the stabilizer ----------------------------------------------------------------------------------------

static setpoint_t command(void *context, const state_t *state, uint32_t step) {
  firmware_t *const f = context;
  return commanded_now(&f->commanded, state, supervised_can_fly(&f->vehicle.supervised), step,
                       firmware_now_ms(f));
}

int firmware_high_level(firmware_t *f, const uint8_t *data, int size) {
  const int result = planner_command(&f->commanded.planner, data, size, firmware_now_ms(f));
  f->params.hlCommander_groupmask = f->commanded.planner.param.groups;
  return result;
}

// --- which controller flies --------------------------------------------------------------------------------

static void select_controller(firmware_t *f) {
  uint8_t *const wanted = &f->params.stabilizer_controller;
  if (*wanted == f->runs) return;
  const bool known = *wanted == CONTROLLER_PID || *wanted == CONTROLLER_INDI || *wanted == CONTROLLER_APP;
  if (!known && *wanted != CONTROLLER_AUTO)
    stand_in_print("DESK: controller %u is not simulated; allowed are 0, 1, 3, 6\n", *wanted);
  *wanted = *wanted == CONTROLLER_AUTO ? CONTROLLER_APP : known ? *wanted : f->runs;
  if (!known && f->changed) f->changed(f->changed_context, firmware_param_find(f, "stabilizer.controller"));
  if (*wanted == f->runs) return;
  f->runs = *wanted;
  if (f->runs == CONTROLLER_APP) controllerOutOfTreeInit();
  if (f->runs == CONTROLLER_PID) stock_pid_reset(&f->vehicle.stock);
  if (f->runs == CONTROLLER_INDI) stock_indi_select(&f->indi);
}

static void run_indi(firmware_t *f, control_t *control) {
  double motor_N[PILOT_MOTORS]; // not used: the firmware's power distribution computes the forces
  stock_indi_step(&f->indi, f->vehicle.now, motor_N);
  const stock_command_t *const c = &f->indi.command;
  control->controlMode = controlModeLegacy;
  control->thrust = (float)c->thrust;
  control->roll = (int16_t)c->roll;
  control->pitch = (int16_t)c->pitch;
  control->yaw = (int16_t)c->yaw;
}

static void fly(void *context, control_t *control, const setpoint_t *set, const sensorData_t *sensors,
                const state_t *state, uint32_t step) {
  firmware_t *const f = context;
  select_controller(f);
  switch (f->runs) {
  case CONTROLLER_PID: f->vehicle.around.stock(&f->vehicle, control, set, sensors, state, step); break;
  case CONTROLLER_INDI: run_indi(f, control); break;
  default: controllerOutOfTree(control, set, sensors, state, step);
  }
}

void firmware_ms(firmware_t *f, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  stand_in = &f->vehicle.around;
  task_run(f->task, firmware_now_ms(f));
  const stock_params_t *const p = &f->params;
  f->vehicle.supervised_by = (supervised_param_t){p->supervisor_prefltTimeout, p->supervisor_landedTimeout,
                                                  p->supervisor_tmblChckEn};
  f->vehicle.stop = f->emergency || p->stabilizer_stop;
  crazyflie_ms(&f->vehicle, in, motor_N);
}

// --- what the app asks of it -------------------------------------------------------------------------------

static void relax(void *context) {
  firmware_t *const f = context;
  commanded_relax(&f->commanded);
}

static int land(void *context, float height_m, float speed_mps, bool relative) {
  firmware_t *const f = context;
  return planner_land(&f->commanded.planner, height_m, speed_mps, relative, firmware_now_ms(f));
}

static void rest(void *context, uint32_t ms) {
  firmware_t *const f = context;
  if (task_runs(f->task)) {
    task_rest(f->task, ms);
    stand_in = &f->vehicle.around;
  } else if (f->rest) {
    f->rest(f->rest_context, ms);
    stand_in = &f->vehicle.around;
  }
}

static void told(void *context, const section_param_t *param, double value) {
  firmware_t *const f = context;
  (void)value;
  for (int i = 0; f->changed && i < sections_params(); i++)
    if (sections_param_at(i, NULL) == param) f->changed(f->changed_context, stock_param_count + i);
}

done_t firmware_open(firmware_t *f, const model_t *model, why_t *why) {
  memset(f, 0, sizeof *f);
  crazyflie_t *const c = &f->vehicle;
  crazyflie_init(c, model);
  stand_in = &c->around; // so that its console gets what is printed before its first millisecond
  f->params = f->params_default = stock_params_default();
  f->app_default = c->app;
  f->runs = CONTROLLER_APP;
  commanded_init(&f->commanded);
  stock_indi_param_t indi = stock_indi_default();
  indi.power = c->firmware;
  (void)stock_indi_pilot(&f->indi, &indi);
  stand_in_t *const around = &c->around;
  around->clocked = true;
  around->relax = relax;
  around->land = land;
  around->commander_context = around->delay_context = around->told_context = f;
  around->delay = rest;
  around->told = told;
  c->command = command;
  c->fly = fly;
  c->command_context = c->fly_context = f;
  f->task = task_open(appMain);
  if (!f->task) return error_failed(why, "out of memory");
  return DONE;
}

void firmware_start(firmware_t *f) {
  crazyflie_start(&f->vehicle);
}

void firmware_close(firmware_t *f) {
  task_close(f->task);
  f->task = NULL;
}

int firmware_console(firmware_t *f, char *text, int size) {
  char *const printed = f->vehicle.around.console;
  const int there = (int)strlen(printed), n = there < size ? there : size - 1;
  memcpy(text, printed, (size_t)n);
  text[n] = '\0';
  memmove(printed, printed + n, strlen(printed + n) + 1);
  return n;
}
