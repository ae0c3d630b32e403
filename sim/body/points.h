// points.h - a vehicle at instants of which each is known: what acts there and what perfect sensors read, of
// eight instants side by side. Nothing moves. Each gets the bits that it gets alone (body/body.h).
#ifndef SIM_BODY_POINTS_H
#define SIM_BODY_POINTS_H

#include "body/body.h"
#include "body/lanes.h"

typedef struct points points_t;

// bits: of the registers, as abreast_open() has it. Null: bits is 0, or there is no memory.
points_t *points_open(int bits);
void points_close(points_t *p);

// From now on it is of this vehicle, as its effects at ticks have left it; instants are span_s apart, and lag
// is done (plain_lag). False: an effect is always looked at alone (body/abreast.h).
bool points_of(points_t *p, const body_t *b, double span_s);

// One effect more that does not act at ticks. False: it is always looked at alone.
bool points_more(points_t *p, const fx_use_t *more);

// So many bytes are kept of eight instants, a multiple of POINTS_ALIGN, at places that are, too.
#define POINTS_ALIGN 64
size_t points_kept_bytes(const points_t *p);

// Each of these of the first n lanes. Returned: the lanes of which it holds, a bit each; the others, which
// differ too much or would need what was before them, are to be looked at alone. No surface is near.
//
// What acts at instants. up: cosines of the tilt.
unsigned points_look(points_t *p, const lanes_instants_t *at, int n, double up[LANES]);
// What is read there. sight: what a range sensor sees, without effects.
unsigned points_read(points_t *p, const lanes_sight_t *sight, lanes_readings_t *to);
// Keeps both.
void points_keep(const points_t *p, void *kept);
// Both at instants that were kept of a vehicle that differs in its effects at ticks alone; the motors did the
// same. moved: its rotors are elsewhere.
unsigned points_read_again(points_t *p, const void *kept, bool moved, int n, lanes_readings_t *to);
// What is read with the one more, at instants that were kept of this vehicle.
unsigned points_read_more(points_t *p, const void *kept, int n, lanes_readings_t *to);

#endif
