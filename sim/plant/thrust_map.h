// thrust_map.h - the steady thrust of one motor in free air from its command and the battery voltage.
#ifndef SIM_PLANT_THRUST_MAP_H
#define SIM_PLANT_THRUST_MAP_H

#include <stdbool.h>

typedef enum {
  THRUST_MAP_NONE,       // no map: commands are in newton
  THRUST_MAP_STAND,      // polynomial of a thrust stand, in grams per motor:
                         //   c0 + c1 p + c2 u + c3 p^2 + c4 p u,  p = pwm/65536, u = vbat/4.2   (Shi et al.)
  THRUST_MAP_VOLT_CUBIC, // newton per motor: c0 + c1 v + c2 v^2 + c3 v^3, v = vbat pwm/65535    (firmware)
  THRUST_MAP_PWM_CUBIC,  // newton per motor: c0 + c1 p + c2 p^2 + c3 p^3, p = pwm/65535, whatever the voltage
  THRUST_MAP_SPEED,      // newton per motor: c0 + c1 w + c2 w^2; the command is the rotor's speed w, rad/s
} thrust_map_kind_t;

typedef struct {
  thrust_map_kind_t kind;
  double c[5];
} thrust_map_t;

// Thrust of one motor, N, >= 0. command: pwm 0..65535, or rad/s; vbat_V: > 0. NaN for THRUST_MAP_NONE.
double thrust_map_N(const thrust_map_t *map, double command, double vbat_V);

// True if the command is a rotor speed in rad/s, not a pwm.
bool thrust_map_takes_speed(const thrust_map_t *map);

bool thrust_map_needs_voltage(const thrust_map_t *map);

#endif
