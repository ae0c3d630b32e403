// bound_plant.h - the plant of the height error's bound (flight/bound.h): a vehicle below a ceiling, and a
// level's sensors.
#ifndef SIM_FLIGHT_BOUND_PLANT_H
#define SIM_FLIGHT_BOUND_PLANT_H

#include "flight/bound.h"
#include "sense/noise.h"
#include "vehicle/model.h"

// Returns the plant of a vehicle that hovers with its rotors gap_m below the ceiling. Constant sensor errors
// (scale, offset, bias) are left out: the bound is that of the error about its mean.
bound_plant_t bound_plant(const model_t *model, const noise_t *noise, double gap_m, bound_force_t force);

// Returns the rms of the bound over the flights of a level, whose gusts' sd differ from flight to flight.
bound_t bound_of_gusts(const model_t *model, const noise_t *noise, double gap_m);

#endif
