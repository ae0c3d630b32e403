// abreast.h - vehicles that are moved eight at a time. Each gets the bits that it gets alone.
//
// Those that are alike (effects that are on, lag, integrator, length of the tick, surfaces that are near) are
// moved together (body/lanes.h), the others one by one. Effects with measured points (form=table), or that
// are in no table, always are.
#ifndef SIM_BODY_ABREAST_H
#define SIM_BODY_ABREAST_H

#include "base/lane.h"
#include "body/body.h"
#include "body/lanes.h"

// Fewer are moved one by one, for what is computed is computed for eight.
#define ABREAST_FEWEST 4

typedef struct abreast abreast_t;

// bits: of the registers, 256 or, as lane_bits() has it, more. Null: bits is 0, or there is no memory.
abreast_t *abreast_open(int bits);
void abreast_close(abreast_t *a);

// Other bodies come, or what was changed of these was not by body.h.
void abreast_forget(abreast_t *a);
void abreast_forget_one(abreast_t *a, int k); // of lane k alone; it is settled

// A tick of each that is no null pointer: body_command() was called, and nothing else. Those that are
// returned (a bit each) were moved together, and are where *seen says; their body_t lags behind, but for
// commands, time and `broken`, until somebody asks for it.
unsigned abreast_move(abreast_t *a, body_t *const b[LANES], lanes_seen_t *seen, double vbat_V[LANES]);

// Whether the next tick of these, and of no others, moves them all as the last one did, and nothing of them
// but their commands has to be asked for. Then these may be given as they lie in lanes: row i is motor i's,
// of all.
bool abreast_again(const abreast_t *a, body_t *const b[LANES]);
// That tick, as body_command() and abreast_move() do it. applied: the commands within limits, as rows. The
// body_t of those that are returned lag behind in all but `broken` and contacts.
unsigned abreast_move_again(abreast_t *a, body_t *const b[LANES], const double *command_N, double *applied_N,
                            lanes_seen_t *seen, double vbat_V[LANES]);

// Before body_command() of a body that may have been moved so.
void abreast_recall(abreast_t *a, int k, body_t *b);

// Before who was moved with others is looked at, or changed, or moved by somebody else.
void abreast_settle(abreast_t *a, int k, body_t *b);
// Those that are not null.
void abreast_settle_all(abreast_t *a, body_t *const b[LANES]);

// What is true before the next tick, of those that are returned: some of those that the last one moved.
unsigned abreast_sense(abreast_t *a, lanes_truth_t *truth);

// How many ticks of a vehicle were moved with others.
long abreast_together(const abreast_t *a);

#endif
