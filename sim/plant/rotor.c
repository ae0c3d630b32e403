// rotor.c - motor commands and battery voltage to thrust.
#include "plant/rotor.h"

#include "base/larger.h"

double rotor_command_N(const thrust_map_t *map, double pwm, double vbat_V, double max_N) {
  const double held = pwm > 0.0 ? smaller(pwm, ROTOR_PWM_MAX) : 0.0; // NaN is 0: the motor is off
  if (map->kind == THRUST_MAP_NONE || thrust_map_takes_speed(map)) return held / ROTOR_PWM_MAX * max_N;
  if (!(vbat_V > 0.0) || !(held > 0.0)) return 0.0;
  return thrust_map_N(map, held, vbat_V);
}

double rotor_pwm(const thrust_map_t *map, double thrust_N, double vbat_V, double max_N) {
  double lo = 0.0, hi = ROTOR_PWM_MAX;
  for (int i = 0; i < 50; i++) {
    const double mid = 0.5 * (lo + hi);
    if (rotor_command_N(map, mid, vbat_V, max_N) < thrust_N)
      lo = mid;
    else
      hi = mid;
  }
  return hi;
}
