// thrust_map.c - motor command and battery voltage to thrust.
#include "plant/thrust_map.h"

#include "base/larger.h"
#include <math.h>

#define NEWTON_PER_GRAM 9.81e-3

double thrust_map_N(const thrust_map_t *map, double command, double vbat_V) {
  const double *c = map->c;
  switch (map->kind) {
  case THRUST_MAP_STAND: {
    const double p = command / 65536.0, u = vbat_V / 4.2;
    // At low commands the polynomial goes below zero; a propeller does not.
    return larger(0.0, NEWTON_PER_GRAM * (c[0] + c[1] * p + c[2] * u + c[3] * p * p + c[4] * p * u));
  }
  case THRUST_MAP_VOLT_CUBIC: {
    const double v = vbat_V * command / 65535.0;
    return larger(0.0, c[0] + v * (c[1] + v * (c[2] + v * c[3])));
  }
  case THRUST_MAP_PWM_CUBIC: {
    const double p = command / 65535.0;
    return larger(0.0, c[0] + p * (c[1] + p * (c[2] + p * c[3])));
  }
  case THRUST_MAP_SPEED: return larger(0.0, c[0] + command * (c[1] + command * c[2]));
  case THRUST_MAP_NONE: break;
  }
  return (double)NAN;
}

bool thrust_map_takes_speed(const thrust_map_t *map) {
  return map->kind == THRUST_MAP_SPEED;
}

bool thrust_map_needs_voltage(const thrust_map_t *map) {
  return map->kind == THRUST_MAP_STAND || map->kind == THRUST_MAP_VOLT_CUBIC;
}
