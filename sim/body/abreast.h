// abreast.h - moves up to eight vehicles at a time. Each gets the bits that it gets alone.
//
// Bodies that are alike (the same effects on, lag, integrator, tick length, and near the same surfaces) are
// moved together (body/lanes.h), the others one by one. Bodies whose effects have measured points
// (form=table) or are in no table are always moved one by one.
#ifndef SIM_BODY_ABREAST_H
#define SIM_BODY_ABREAST_H

#include "base/lane.h"
#include "body/body.h"
#include "body/lanes.h"

// Fewer are moved one by one, because the work is always done for eight.
#define ABREAST_FEWEST 4

typedef struct abreast abreast_t;

// bits: width of the registers, 256 or 512, from lane_bits(). Null if bits is 0 or there is no memory.
abreast_t *abreast_open(int bits);
void abreast_close(abreast_t *a);

// Call it when other bodies come, or these were changed otherwise than by body.h.
void abreast_forget(abreast_t *a);
void abreast_forget_one(abreast_t *a, int k); // lane k alone, which must be settled

// One tick of each body that is not null, after body_command() and nothing else. Returns the bodies that were
// moved together, one bit each; *seen and vbat_V are theirs. Their body_t lag behind, except for commands,
// time and `broken`, until they are settled.
unsigned abreast_move(abreast_t *a, body_t *const b[LANES], lanes_seen_t *seen, double vbat_V[LANES]);

// True if the next tick of exactly these bodies moves all of them as the last one did and needs nothing but
// their commands. These may then be given as rows: row i is motor i of all bodies.
bool abreast_again(const abreast_t *a, body_t *const b[LANES]);
// Does that tick, as body_command() and abreast_move() would. applied_N: the limited commands, as rows. The
// body_t of the bodies returned lag behind in all but `broken` and contacts.
unsigned abreast_move_again(abreast_t *a, body_t *const b[LANES], const double *command_N, double *applied_N,
                            lanes_seen_t *seen, double vbat_V[LANES]);

// Call it before body_command() of a body that abreast_move_again() may have moved.
void abreast_recall(abreast_t *a, int k, body_t *b);

// Brings b up to date. Call it before other code reads, changes or moves a body that was moved with others.
void abreast_settle(abreast_t *a, int k, body_t *b);
// The same for all bodies that are not null.
void abreast_settle_all(abreast_t *a, body_t *const b[LANES]);

// Sets *truth to what is true before the next tick. Returns the bodies for which it holds: some of those that
// the last tick moved.
unsigned abreast_sense(abreast_t *a, lanes_truth_t *truth);

// The number of ticks, counted per body, that were done together with others.
long abreast_together(const abreast_t *a);

#endif
