// pm.h - stand-in: power management.
#ifndef CRAZYFLIE_PM_H
#define CRAZYFLIE_PM_H

float pmGetBatteryVoltage(void); // V, as last measured

#endif
