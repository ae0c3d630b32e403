// around.c - the surroundings of the app where there is no host: of the stand-ins' calls those that it needs.
#include "controller_pid.h"
#include "range.h"
#include "stand_in.h"
#include "supervisor.h"

stand_in_t *stand_in;

float rangeGet(rangeDirection_t direction) {
  return stand_in->range_mm[direction];
}
bool supervisorIsFlying(void) {
  return stand_in->flying;
}
bool supervisorAreMotorsAllowedToRun(void) {
  return stand_in->motors_allowed;
}
void controllerPidInit(void) {}
void controllerPid(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                   const state_t *state, const stabilizerStep_t step) {
  (void)setpoint, (void)sensors, (void)state, (void)step;
  *control = (control_t){.controlMode = controlModeForce};
}
