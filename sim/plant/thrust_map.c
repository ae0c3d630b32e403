// thrust_map.c - motor command and battery voltage to thrust.
#include "plant/thrust_map.h"

#include <math.h>

#define NEWTON_PER_GRAM 9.81e-3

PAIR_COPIES pair_t thrust_map_pair_N(const thrust_map_t *map, pair_t command, double vbat_V) {
  const double *c = map->c;
  const pair_t zero = pair_both(0.0);
  switch (map->kind) {
  case THRUST_MAP_STAND: {
    const pair_t p = command / 65536.0;
    const double u = vbat_V / 4.2;
    // At low commands the polynomial goes below zero; a propeller does not.
    return pair_max(NEWTON_PER_GRAM * (c[0] + c[1] * p + c[2] * u + c[3] * p * p + c[4] * p * u), zero);
  }
  case THRUST_MAP_VOLT_CUBIC: {
    const pair_t v = vbat_V * command / 65535.0;
    return pair_max(c[0] + v * (c[1] + v * (c[2] + v * c[3])), zero);
  }
  case THRUST_MAP_PWM_CUBIC: {
    const pair_t p = command / 65535.0;
    return pair_max(c[0] + p * (c[1] + p * (c[2] + p * c[3])), zero);
  }
  case THRUST_MAP_SPEED: return pair_max(c[0] + command * (c[1] + command * c[2]), zero);
  case THRUST_MAP_NONE: break;
  }
  return pair_both((double)NAN);
}

double thrust_map_N(const thrust_map_t *map, double command, double vbat_V) {
  return thrust_map_pair_N(map, pair_both(command), vbat_V)[0];
}

bool thrust_map_takes_speed(const thrust_map_t *map) {
  return map->kind == THRUST_MAP_SPEED;
}

bool thrust_map_needs_voltage(const thrust_map_t *map) {
  return map->kind == THRUST_MAP_STAND || map->kind == THRUST_MAP_VOLT_CUBIC;
}
