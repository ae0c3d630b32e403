// flights.h - short ways to fly in a test.
#ifndef TEST_RIG_FLIGHTS_H
#define TEST_RIG_FLIGHTS_H

#include "flight/scenario.h"

// Returns appendix A's set-up, flown by `kind`, with the plant's theoretical ceiling effect or none.
// cutoff_Hz 0: signals are not filtered. lead_s: K_v. It integrates with our own Runge-Kutta; that one is
// checked elsewhere.
setup_t flights_appendix_a(fly_kind_t kind, float cutoff_Hz, float lead_s, bool ceiling);

// Flies; returns the flight's last segment. contacts (or null) counts over the whole flight.
segment_t flights_last(const setup_t *setup, int *contacts);

// The same, flown by another pilot than the set-up's.
segment_t flights_last_by(const setup_t *setup, const pilot_t *pilot, int *contacts);

#endif
