// rotor.h - the steady thrust of each rotor in free air from its motor command and the battery voltage.
#ifndef SIM_PLANT_ROTOR_H
#define SIM_PLANT_ROTOR_H

#include "plant/rigid.h"
#include "plant/thrust_map.h"

#define ROTOR_PWM_MAX 65535.0

// Thrust of one motor, N, >= 0, at pwm (limited to 0..65535) and vbat_V; 0 if vbat_V is not above 0. With
// THRUST_MAP_NONE or a map that takes speeds, the thrust is pwm/65535 times max_N, whatever the voltage.
double rotor_command_N(const thrust_map_t *map, double pwm, double vbat_V, double max_N);
// The same for all rotors.
void rotor_commands_N(const thrust_map_t *map, const double pwm[ROTORS], double vbat_V, double max_N,
                      double command_N[ROTORS]);

// The pwm that gives thrust_N at vbat_V, by bisection; 65535 if none does.
double rotor_pwm(const thrust_map_t *map, double thrust_N, double vbat_V, double max_N);

#endif
