// flight_state.h - whether all of the controller's state is still numbers.
#ifndef TEST_RIG_FLIGHT_STATE_H
#define TEST_RIG_FLIGHT_STATE_H

#include "flight/flight.h"

// The name of a part of the state that is not finite; null: all of it is.
const char *flight_not_finite(const flight_t *f);

#endif
