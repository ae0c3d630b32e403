// rotor.c - thrust from motor commands and battery voltage.
#include "plant/rotor.h"

#include "plant/thrust_map_few.h"

FEW_INLINE few_t command_N(const thrust_map_t *map, few_t pwm, double vbat_V, double max_N) {
  const few_t off = few_all(0.0);
  const few_t held = few_min(few_max(pwm, off), few_all(ROTOR_PWM_MAX)); // NaN becomes 0: the motor is off
  if (map->kind == THRUST_MAP_NONE || map->kind == THRUST_MAP_SPEED) return held / ROTOR_PWM_MAX * max_N;
  if (!(vbat_V > 0.0)) return off;
  return few_where(held > off, thrust_map_few_N(map, held, vbat_V), off);
}

PAIR_COPIES void rotor_commands_N(const thrust_map_t *map, const double pwm[ROTORS], double vbat_V,
                                  double max_N, double out_N[ROTORS]) {
  for (int i = 0; i < ROTORS; i += FEW_N) few_put(out_N + i, command_N(map, few_of(pwm + i), vbat_V, max_N));
}

double rotor_command_N(const thrust_map_t *map, double pwm, double vbat_V, double max_N) {
  return command_N(map, few_all(pwm), vbat_V, max_N)[0];
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
