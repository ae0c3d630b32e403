// controller_pid.h - stand-in: the stock controller, which is stand_in_t.stock.
#ifndef CRAZYFLIE_CONTROLLER_PID_H
#define CRAZYFLIE_CONTROLLER_PID_H

#include "stabilizer_types.h"

void controllerPidInit(void);
void controllerPid(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                   const state_t *state, const stabilizerStep_t stabilizerStep);

#endif
