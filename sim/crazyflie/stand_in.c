// stand_in.c - the functions behind the stand-ins.
#include "stand_in.h"

#include "commander.h"
#include "controller_pid.h"
#include "crtp_commander_high_level.h"
#include "crtp_supervisor.h"
#include "firmware/glue.h"
#include "param.h"
#include "task.h"
#include "values.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

_Thread_local stand_in_t *stand_in;

void controllerPid(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                   const state_t *state, const stabilizerStep_t step) {
  if (stand_in->stock)
    stand_in->stock(stand_in->stock_context, control, setpoint, sensors, state, step);
  else
    *control = (control_t){.controlMode = controlModeForce};
}

paramVarId_t paramGetVarId(const char *group, const char *name) {
  if (strcmp(group, "deck") != 0) return (paramVarId_t){.valid = false};
  if (strcmp(name, "bcFlow2") == 0) return (paramVarId_t){true, stand_in->has_flow, NULL};
  if (strcmp(name, "bcMultiranger") == 0) return (paramVarId_t){true, stand_in->has_multiranger, NULL};
  if (strcmp(name, "bcUSD") == 0 && !stand_in->no_usd_driver)
    return (paramVarId_t){true, stand_in->has_usd, NULL};
  return (paramVarId_t){.valid = false};
}

unsigned paramGetUint(paramVarId_t id) {
  return id.deck;
}

paramVarId_t paramGetVarIdFromComplete(const char *name) {
  const section_param_t *const param = sections_param(name);
  return (paramVarId_t){param != NULL, 0, param};
}

static void tell(const section_param_t *param, double value) {
  void *const at = stand_in_own(stand_in, param->address);
  values_put(param->type, at, value);
  if (stand_in->told) stand_in->told(stand_in->told_context, param, values_of_param(param->type, at));
  if (param->callback) param->callback();
}

void paramSetInt(paramVarId_t id, int value) {
  tell(id.param, id.param->type & PARAM_UINT8 ? (double)(unsigned)value : (double)value);
}
void paramSetFloat(paramVarId_t id, float value) {
  tell(id.param, (double)value);
}

void *stand_in_own(const stand_in_t *around, const void *address) {
  const ptrdiff_t offset = (const char *)address - (const char *)&glue_static;
  return (char *)around->app + offset;
}

void crtpSupervisorNotifyEmergencyStopWatchdog(void) {
  stand_in->fed_ms = stand_in->clock_ms;
}
uint32_t crtpSupervisorGetEmergencyStopWatchdogNotificationTick(void) {
  return stand_in->fed_ms;
}

void commanderRelaxPriority(void) {
  stand_in->relaxed++;
  if (stand_in->relax) stand_in->relax(stand_in->commander_context);
}
int crtpCommanderHighLevelLandWithVelocity(const float height_m, const float velocity_m_s, bool relative) {
  stand_in->landings += !relative;
  stand_in->landing_m = height_m;
  stand_in->landing_mps = velocity_m_s;
  if (stand_in->land) return stand_in->land(stand_in->commander_context, height_m, velocity_m_s, relative);
  return stand_in->no_landing;
}

TickType_t xTaskGetTickCount(void) {
  return stand_in->clock_ms;
}
void vTaskDelay(TickType_t ticks) {
  if (!stand_in->clocked) stand_in->clock_ms += ticks;
  if (stand_in->delay) stand_in->delay(stand_in->delay_context, ticks);
}

void stand_in_print(const char *format, ...) {
  char line[256];
  va_list args;
  va_start(args, format);
  vsnprintf(line, sizeof line, format, args);
  va_end(args);
  char *const text = stand_in->console;
  const size_t used = strlen(text), size = strlen(line);
  const size_t over = used + size < STAND_IN_CONSOLE ? 0 : used + size - (STAND_IN_CONSOLE - 1);
  memmove(text, text + over, used - over + 1);
  memcpy(text + used - over, line, size + 1);
}
