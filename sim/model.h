// model.h - what the simulator takes a vehicle and its surroundings to be: numbers, map and effects.
//
// A vehicle file (sim/vehicles/*.toml) holds exactly this. Sources of the numbers stand in the file.
#ifndef SIM_MODEL_H
#define SIM_MODEL_H

#include "effects/fx.h"
#include "error.h"
#include "plant/thrust_map.h"

typedef struct {
  char name[64];
  double mass_kg;        // > 0, ready to fly
  double rotor_radius_m; // > 0
  double motor_tau_s;    // > 0   first-order lag
  double thrust_min_N;   // of all motors together; below 0 only in the thesis's section 4.2
  double thrust_max_N;   // > thrust_min_N
  thrust_map_t map;      // PWM and volts to newton per motor
  double ceiling_m;      // height of the ceiling, INFINITY: none; z = 0 is the ground
  int n_fx;
  fx_use_t fx[FX_MAX]; // what acts; at most one of a name
} model_t;

// Switches an effect on, or replaces the one of that name. ST_BAD_INPUT: FX_MAX are on already.
MUST_CHECK status_t model_add_fx(model_t *m, const fx_use_t *use, why_t *why);

// What the rotors' thrust is multiplied by at this place: 1 and the excess of every effect (thesis 3.1.4).
double model_thrust_ratio(const model_t *m, const fx_place_t *place);

#endif
