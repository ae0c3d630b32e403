// bound_plant.h - what the bound of the height error (flight/bound.h) is asked about: a vehicle below a
// ceiling, and a level's sensors.
#ifndef SIM_FLIGHT_BOUND_PLANT_H
#define SIM_FLIGHT_BOUND_PLANT_H

#include "flight/bound.h"
#include "sense/noise.h"
#include "vehicle/model.h"

// Hovering with its rotors gap_m below the ceiling. Errors that stay (scale, offset, bias) are none: what is
// asked is the error about the mean.
bound_plant_t bound_plant(const model_t *model, const noise_t *noise, double gap_m, bound_force_t force);

// rms over the flights of a level: its gusts' sd differ from flight to flight.
bound_t bound_of_gusts(const model_t *model, const noise_t *noise, double gap_m);

#endif
