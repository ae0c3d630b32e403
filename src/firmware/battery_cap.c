// battery_cap.c - a low battery caps the thrust.
#include "battery_cap.h"

#include "flight/v3.h"
#include "motors.h"
#include "platform_defaults.h"
#include "pm.h"

#define DUTY_MAX 65535.0f

// Returns the thrust at a motor voltage, by the firmware's map of these propellers.
static float of_voltage_N(float motor_V) {
  return VMOTOR2THRUST0 + motor_V * (VMOTOR2THRUST1 + motor_V * (VMOTOR2THRUST2 + motor_V * VMOTOR2THRUST3));
}

void battery_cap(float force_N[MOTORS]) {
  const float supply_V = pmGetBatteryVoltage();
  if (of_voltage_N(supply_V) >= THRUST_MAX) return; // enough for any thrust that can be asked for
  uint16_t duty[MOTORS];
  bool full = false;
  for (unsigned i = 0; i < MOTORS; i++) {
    duty[i] = motorsGetRatio(i);
    full = full || duty[i] == UINT16_MAX;
  }
  if (!full) return;
  const float motor_V = supply_V / DUTY_MAX;
  for (int i = 0; i < MOTORS; i++)
    force_N[i] = f_clamp(of_voltage_N(motor_V * (float)duty[i]), 0.0f, force_N[i]);
}
