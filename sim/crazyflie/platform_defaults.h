// platform_defaults.h - stand-in: numbers of the vehicle that is flown; the constants are of legacy
// propellers.
#ifndef CRAZYFLIE_PLATFORM_DEFAULTS_H
#define CRAZYFLIE_PLATFORM_DEFAULTS_H

#include "stand_in.h"

#define ARM_LENGTH    0.046f
#define THRUST2TORQUE 0.00735f
#define THRUST_MAX    (stand_in->thrust_max_N)

#endif
