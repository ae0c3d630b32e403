// watch.h - the guard's part of one call: time and loops that are due, corrected inputs, the set point flown.
#ifndef FLIGHT_WATCH_H
#define FLIGHT_WATCH_H

#include "flight/flight.h"

// Finds the time since the last call and the loops that are due. False if this count was handled already.
bool watch_time(flight_t *f, uint32_t step);

// Lets the guard judge, and changes *in to what is to be flown.
void watch_inputs(flight_t *f, flight_in_t *in);

// True if the set point is finite and within what a pilot may ask for.
bool watch_setpoint_good(const flight_setpoint_t *sp);

#endif
