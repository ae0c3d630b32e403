// abreast.h - vehicles that are moved eight at a time. Each gets the bits that it gets alone.
//
// Those that are alike (effects that are on, lag, integrator, length of the tick) and away from surfaces are
// moved together (body/lanes.h), the others one by one. Effects with measured points (form=table), or that
// are in no table, always are.
#ifndef SIM_BODY_ABREAST_H
#define SIM_BODY_ABREAST_H

#include "base/lane.h"
#include "body/body.h"

// Fewer are moved one by one, for what is computed is computed for eight.
#define ABREAST_FEWEST 4

typedef struct abreast abreast_t;

// Null: the processor cannot do it, or there is no memory.
abreast_t *abreast_open(void);
void abreast_close(abreast_t *a);

// Other bodies come, or what was changed of these was not by body.h.
void abreast_forget(abreast_t *a);

// A tick of each that is no null pointer: body_command() was called.
void abreast_move(abreast_t *a, body_t *const b[LANES]);

// How many ticks of a vehicle were moved with others.
long abreast_together(const abreast_t *a);

#endif
