// rotor.h - motor commands and battery voltage to the thrust that each rotor will settle at, in free air.
#ifndef SIM_PLANT_ROTOR_H
#define SIM_PLANT_ROTOR_H

#include "plant/rigid.h"
#include "plant/thrust_map.h"

#define ROTOR_PWM_MAX 65535.0

// Newton of one motor at pwm (limited to 0..65535) and vbat_V, within 0..max_N. 0 where vbat_V is not above
// 0. THRUST_MAP_NONE, and a map that takes speeds: pwm is a share of max_N, in 65535ths, whatever the
// voltage.
double rotor_command_N(const thrust_map_t *map, double pwm, double vbat_V, double max_N);
// The same of all.
void rotor_commands_N(const thrust_map_t *map, const double pwm[ROTORS], double vbat_V, double max_N,
                      double command_N[ROTORS]);

// The pwm that gives thrust_N at vbat_V, by bisection; 65535 where there is none.
double rotor_pwm(const thrust_map_t *map, double thrust_N, double vbat_V, double max_N);

#endif
