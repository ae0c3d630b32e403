// watch.h - what the guard makes of one call: time, the inputs that are to be used, the set point that is
// flown.
#ifndef FLIGHT_WATCH_H
#define FLIGHT_WATCH_H

#include "flight/flight.h"

// The time since the last call, and which loops are due. False: this count was here already.
bool watch_time(flight_t *f, uint32_t step);

// Lets the guard judge, and changes *in to what is to be flown.
void watch_inputs(flight_t *f, flight_in_t *in);

// Finite, and not beyond what a pilot may ask for.
bool watch_setpoint_good(const flight_setpoint_t *sp);

#endif
