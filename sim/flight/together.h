// together.h - many flights in one thread, eight at a time. Each gets the bits that it gets alone.
//
// A flight is any function that comes to loop_fly(), whatever it does before and after; there it waits for
// the others, and all that wait are flown at once: sensors, estimator, flight code and nature in lanes
// (flight/lanes_state.h, body/lanes.h). What of them parts does that millisecond alone.
#ifndef SIM_FLIGHT_TOGETHER_H
#define SIM_FLIGHT_TOGETHER_H

#include "flight/loop_parts.h"

// Fewer are flown one by one, for what is computed is computed for eight.
#define TOGETHER_FEWEST 6

// Calls flight(context, i), i from 0 to n-1; the calls overlap. Where the processor cannot do it, or there is
// no memory, they come one after the other. Returns how many milliseconds of a flight were flown with others.
long together(int n, void (*flight)(void *context, int i), void *context);

// --- the inside (loop.c) -----------------------------------------------------------------------------------

// Whether this flight is one of such, and can be flown with others.
bool together_waits(const flight_loop_t *f);
// To its end, as loop_fly.
MUST_CHECK done_t together_fly(flight_loop_t *f, record_t *record, bool *finite, why_t *why);

#endif
