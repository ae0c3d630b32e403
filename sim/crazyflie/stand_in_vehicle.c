// stand_in_vehicle.c - what the app asks of the vehicle, on the host and on the emulated processor alike.
#include "controller_pid.h"
#include "motors.h"
#include "pm.h"
#include "range.h"
#include "stand_in.h"
#include "supervisor.h"

float rangeGet(rangeDirection_t direction) {
  return stand_in->range_mm[direction];
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

void controllerPidInit(void) {}
