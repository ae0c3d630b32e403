// settings.h - from parameters that are written one by one to sets that are flown as a whole.
//
// The parameters are the fields of GLUE.tuned. After every write the parameter task checks the whole set. A
// set that passes is flown as a whole from the next tick on. A set that fails is counted, the last good one
// stays in use, and values out of range get their old value back. The weights of both curves, w1..w7 of ceil
// and of ground, are one set and wait for ceil.commit:
//   1  takes them at once
//   2  copies the learned ones into them (the logs rls.w1..w7, ground.w1..w7), and takes those; refused while
//      learning
// Either way learning goes on from there.
//
// A client stores parameters one by one, and may be interrupted. So a commit also computes ceil.wSum, a
// checksum of the weights, and at the start only weights that have this checksum are flown. It is 0 for the
// weights of the table, so that a vehicle on which nothing was stored flies them.
#ifndef FIRMWARE_SETTINGS_H
#define FIRMWARE_SETTINGS_H

#include "flight/params.h"
#include <stdbool.h>

// Starts a fresh controller with the present parameters. Refused values are put back to those that flew
// before, at first to the defaults; weights that do not belong together (GLUE.weights_mixed) all at once.
// Typed weights whose commit is pending are taken.
void settings_start(void);

// Call once a tick, before anything else: takes a set or a commit that is ready. Acts in every second tick,
// and in none while a loop waits after missed calls.
void settings_take(void);

// Call once a tick, after flight_step. In the one tick in ten in which flight_step repairs what it computes
// from its parameters, restores these from GLUE.flown, as a flipped bit in them would stay for ever. While
// calls are late and loops wait, takes a set or a commit instead.
void settings_mend(void);

// True for w1..w7 of ceil and ground.
bool settings_is_weight(const param_row_t *row);

// True if a curve may be learning now.
bool settings_learning(void);

// Call after every write, in the parameter task: judges the set, and notes what it puts back in
// GLUE.put_back.
void settings_touched(void);

#endif
