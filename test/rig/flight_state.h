// flight_state.h - checks that the controller's whole state is finite.
#ifndef TEST_RIG_FLIGHT_STATE_H
#define TEST_RIG_FLIGHT_STATE_H

#include "flight/flight.h"

// Returns the name of a part of the state that is not finite, or null if all is.
const char *flight_not_finite(const flight_t *f);

#endif
