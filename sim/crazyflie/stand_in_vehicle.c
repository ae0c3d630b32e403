// stand_in_vehicle.c - what the app asks of the vehicle, on the host and on the emulated processor alike.
#include "controller_pid.h"
#include "eventtrigger.h"
#include "motors.h"
#include "pm.h"
#include "range.h"
#include "stand_in.h"
#include "supervisor.h"
#include "usddeck.h"
#include <stddef.h>

float rangeGet(rangeDirection_t direction) {
  return stand_in->range_mm[direction];
}

bool supervisorCanFly(void) {
  return stand_in->can_fly;
}
bool supervisorIsFlying(void) {
  return stand_in->flying;
}
bool supervisorAreMotorsAllowedToRun(void) {
  return stand_in->motors_allowed;
}

uint16_t motorsGetRatio(uint32_t motor) {
  return stand_in->duty[motor];
}
float pmGetBatteryVoltage(void) {
  return stand_in->battery_V;
}

bool usddeckLoggingEnabled(void) {
  return stand_in->event != NULL;
}
void eventTrigger(const eventtrigger *event) {
  if (stand_in->event) stand_in->event(stand_in->event_context, event->name);
}

void controllerPidInit(void) {
  stand_in->stock_starts++;
}
