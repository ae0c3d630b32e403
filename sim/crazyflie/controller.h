// controller.h - stand-in: what an app's controller has to define.
#ifndef CRAZYFLIE_CONTROLLER_H
#define CRAZYFLIE_CONTROLLER_H

#include "stabilizer_types.h"

void controllerOutOfTreeInit(void);
bool controllerOutOfTreeTest(void);
void controllerOutOfTree(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                         const state_t *state, const stabilizerStep_t stabilizerStep);

#endif
