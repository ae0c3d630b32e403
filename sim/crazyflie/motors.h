// motors.h - stand-in: the motors' duty.
#ifndef CRAZYFLIE_MOTORS_H
#define CRAZYFLIE_MOTORS_H

#include <stdint.h>

// Duty of motor 0..3 as it was last set, after all caps; 65535 is full.
uint16_t motorsGetRatio(uint32_t motor);

#endif
