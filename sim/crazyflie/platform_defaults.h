// platform_defaults.h - stand-in: numbers of the vehicle that this thread flies; the constants are those of
// legacy propellers.
#ifndef CRAZYFLIE_PLATFORM_DEFAULTS_H
#define CRAZYFLIE_PLATFORM_DEFAULTS_H

#include "stand_in.h"

#define CONFIG_CRAZYFLIE_LEGACY_PROPELLERS 1

#define ARM_LENGTH    0.046f
#define THRUST2TORQUE 0.00735f
#define THRUST_MAX    (stand_in->thrust_max_N)

#define VMOTOR2THRUST0 (stand_in->volt_N[0])
#define VMOTOR2THRUST1 (stand_in->volt_N[1])
#define VMOTOR2THRUST2 (stand_in->volt_N[2])
#define VMOTOR2THRUST3 (stand_in->volt_N[3])

#endif
