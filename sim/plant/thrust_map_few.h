// thrust_map_few.h - the thrusts of a few motors at once (plant/thrust_map.h). Header only.
#ifndef SIM_PLANT_THRUST_MAP_FEW_H
#define SIM_PLANT_THRUST_MAP_FEW_H

#include "base/few.h"
#include "plant/thrust_map.h"
#include <math.h>

#define NEWTON_PER_GRAM 9.81e-3

// The same as thrust_map_N() for each motor.
FEW_INLINE few_t thrust_map_few_N(const thrust_map_t *map, few_t command, double vbat_V) {
  const double *c = map->c;
  const few_t zero = few_all(0.0);
  switch (map->kind) {
  case THRUST_MAP_STAND: {
    const few_t p = command / 65536.0;
    const double u = vbat_V / 4.2;
    // At low commands the polynomial is negative; a propeller's thrust is not.
    return few_max(NEWTON_PER_GRAM * (c[0] + c[1] * p + c[2] * u + c[3] * p * p + c[4] * p * u), zero);
  }
  case THRUST_MAP_VOLT_CUBIC: {
    const few_t v = vbat_V * command / 65535.0;
    return few_max(c[0] + v * (c[1] + v * (c[2] + v * c[3])), zero);
  }
  case THRUST_MAP_PWM_CUBIC: {
    const few_t p = command / 65535.0;
    return few_max(c[0] + p * (c[1] + p * (c[2] + p * c[3])), zero);
  }
  case THRUST_MAP_SPEED: return few_max(c[0] + command * (c[1] + command * c[2]), zero);
  case THRUST_MAP_NONE: break;
  }
  return few_all((double)NAN);
}

#endif
