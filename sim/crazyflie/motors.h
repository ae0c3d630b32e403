// motors.h - stand-in: what the motors get.
#ifndef CRAZYFLIE_MOTORS_H
#define CRAZYFLIE_MOTORS_H

#include <stdint.h>

// Duty of motor 0..3 as it was set last, after every cap; 65535 is full.
uint16_t motorsGetRatio(uint32_t motor);

#endif
