// around.c - the app's surroundings where there is no host: those calls of the stand-ins that the app needs.
#include "controller_pid.h"
#include "firmware/client.h"
#include "stand_in.h"

stand_in_t *stand_in;

void client_wrote(void) {} // nobody listens; pil.c itself has a write judged

void controllerPid(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                   const state_t *state, const stabilizerStep_t step) {
  (void)setpoint, (void)sensors, (void)state, (void)step;
  *control = (control_t){.controlMode = controlModeForce};
}
