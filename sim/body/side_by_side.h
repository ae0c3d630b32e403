// side_by_side.h - jobs in one thread that each move a body, tick by tick, and look at it in between: their
// ticks are computed eight at a time (body/abreast.h). Each gets the bits that it gets alone.
#ifndef SIM_BODY_SIDE_BY_SIDE_H
#define SIM_BODY_SIDE_BY_SIDE_H

#include "body/body.h"

// How many of n jobs one call should run when there are that many threads; 1 if there are too few.
int side_by_side_share(int n, int threads);

// Calls job(context, i) for i = 0..n-1; the calls overlap. They run one after the other if the processor
// cannot do it or there is no memory. Returns how many ticks were computed together with others.
long side_by_side(int n, void (*job)(void *context, int i), void *context);

// The same, distributed over the available threads.
void side_by_side_shared(int n, void (*job)(void *context, int i), void *context);

// The same as body_tick(). Between two ticks, a job may change the body only by body.h (and `vbat_V`, which
// effects see); else its results are not those that it gets alone. Before the first tick, any change is
// allowed.
void side_by_side_tick(body_t *b, const double command_N[ROTORS], double span_s);

#endif
