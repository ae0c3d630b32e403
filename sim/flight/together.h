// together.h - many flights in one thread, eight at a time. Each has the same result, to the bit, as alone.
//
// A flight is any function that calls loop_fly(), whatever it does before and after. There it waits for the
// others, and all that wait are flown at once: sensors, estimator, flight code and nature in lanes
// (flight/lanes_state.h, body/lanes.h). A flight that branches differently parts from the others, and does
// that millisecond alone.
#ifndef SIM_FLIGHT_TOGETHER_H
#define SIM_FLIGHT_TOGETHER_H

#include "flight/loop_parts.h"

// Fewer are flown one by one, because lanes always compute eight.
#define TOGETHER_FEWEST 6

// Calls flight(context, i) for i from 0 to n-1; the calls overlap. Where the processor cannot do it, or there
// is no memory, they come one after the other. Returns the sum over the flights of the milliseconds that were
// flown with others.
long together(int n, void (*flight)(void *context, int i), void *context);

// --- the inside (loop.c) -----------------------------------------------------------------------------------

// True if together() called this flight, and it can be flown with others.
bool together_waits(const flight_loop_t *f);
// Flies it to its end, with others. Errors as loop_fly.
MUST_CHECK done_t together_fly(flight_loop_t *f, record_t *record, bool *finite, why_t *why);

#endif
