// side_by_side.h - jobs in one thread that move a body each, tick by tick, and look at it in between: their
// ticks are done eight at a time (body/abreast.h). Each gets the bits that it gets alone.
#ifndef SIM_BODY_SIDE_BY_SIDE_H
#define SIM_BODY_SIDE_BY_SIDE_H

#include "body/body.h"

// How many of n jobs, for so many threads, are best done by one call: 1 where they are too few.
int side_by_side_share(int n, int threads);

// Calls job(context, i), i from 0 to n-1; the calls overlap. Where the processor cannot do it, or there is no
// memory, they come one after the other. Returns how many ticks were done with others'.
long side_by_side(int n, void (*job)(void *context, int i), void *context);

// The same, shared out over the threads that there are.
void side_by_side_shared(int n, void (*job)(void *context, int i), void *context);

// As body_tick(). Between two ticks a job that changes of the body what body.h does not (`vbat_V` is what the
// effects see, and may be changed) has its own bits no more; before the first it may.
void side_by_side_tick(body_t *b, const double command_N[ROTORS], double span_s);

#endif
