// flights.h - short ways to fly in a test.
#ifndef TEST_RIG_FLIGHTS_H
#define TEST_RIG_FLIGHTS_H

#include "flight/scenario.h"

// Appendix A's set-up with the theory's ceiling effect of the plant (or none), flown by `kind`.
// cutoff_Hz: 0 = signals not filtered. lead_s: K_v. The integrator is the one by hand; it is checked
// elsewhere.
setup_t flights_appendix_a(fly_kind_t kind, float cutoff_Hz, float lead_s, bool ceiling);

// The last segment of the flight; contacts counts the whole flight.
segment_t flights_last(const setup_t *setup, int *contacts);

// The same with a pilot that is not one of the set-up's.
segment_t flights_last_by(const setup_t *setup, const pilot_t *pilot, int *contacts);

#endif
