// points.h - what acts on a vehicle at given instants, and what perfect sensors read there, eight instants
// side by side. Nothing moves. Each instant gets the bits that it gets alone (body/body.h).
#ifndef SIM_BODY_POINTS_H
#define SIM_BODY_POINTS_H

#include "body/body.h"
#include "body/lanes.h"

typedef struct points points_t;

// bits: width of the registers, as for abreast_open(). Null if bits is 0 or there is no memory.
points_t *points_open(int bits);
void points_close(points_t *p);

// Sets the vehicle, as its effects at ticks have left it; instants are span_s apart. The motors' lag counts
// as done (plain_lag). False if the body is held or moves vertically only, or an effect can only be evaluated
// alone (body/abreast.h).
bool points_of(points_t *p, const body_t *b, double span_s);

// Sets one more effect, which must not act at ticks. False if it can only be evaluated alone.
bool points_more(points_t *p, const fx_use_t *more);

// The bytes needed to keep eight instants, a multiple of POINTS_ALIGN, to which the memory must be aligned.
#define POINTS_ALIGN 64
size_t points_kept_bytes(const points_t *p);

// The following evaluate the first n lanes and return those for which the result holds, one bit each. The
// others, which differ too much or need the instant before them, must be evaluated alone. No surface may be
// near.
//
// What acts at the instants. up: cosines of the tilt.
unsigned points_look(points_t *p, const lanes_instants_t *at, int n, double up[LANES]);
// What sensors read there. sight: what a range sensor sees, without effects.
unsigned points_read(points_t *p, const lanes_sight_t *sight, lanes_readings_t *to);
// Keeps the results of both.
void points_keep(const points_t *p, void *kept);
// Both at instants kept of a vehicle that differs only in its effects at ticks, with the same thrusts. moved:
// its rotors are in other places.
unsigned points_read_again(points_t *p, const void *kept, bool moved, int n, lanes_readings_t *to);
// What sensors read with the additional effect, at instants kept of this vehicle.
unsigned points_read_more(points_t *p, const void *kept, int n, lanes_readings_t *to);

#endif
