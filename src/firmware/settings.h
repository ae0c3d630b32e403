// settings.h - from parameters that are written one by one to sets that are flown as a whole.
//
// The parameters are the fields of GLUE.tuned. After every write the set is checked, in the parameter task;
// one that passes is flown as a whole from the next tick on. One that fails is counted, the last good one
// flies on, and what is out of its range gets its old value back. The weights of both curves, w1..w7 of ceil
// and of ground, are one set and wait for ceil.commit:
//   1  takes them at once
//   2  copies the learned ones into them (the logs rls.w1..w7, ground.w1..w7), and takes those; refused while
//      learning
// Either way learning goes on from there.
//
// A client stores parameters one by one, and may be interrupted. So a commit also makes ceil.wSum of the
// weights: only those whose sum it is are flown at the start. It is 0 for the weights of the table, so that a
// vehicle on which nothing was stored flies them.
#ifndef FIRMWARE_SETTINGS_H
#define FIRMWARE_SETTINGS_H

#include "flight/params.h"
#include <stdbool.h>

// A fresh controller with what the parameters say now. What is refused is put back to what flew before, to
// the defaults at first; weights that do not belong together (GLUE.weights_mixed) as a whole. Weights whose
// commit waits for this are taken.
void settings_start(void);

// Once a tick, before anything else; acts in every second one, and in none while a loop waits after missed
// calls.
void settings_take(void);

// Once a tick, after flight_step; acts in the one in ten in which that mends what it makes of the parameters:
// a bit that flipped in them would stay for ever. Where loops wait for as long as calls are late, a set or a
// commit is taken here.
void settings_mend(void);

// One of w1..w7 of ceil or ground.
bool settings_is_weight(const param_row_t *row);

// The curve may be learning now.
bool settings_learning(void);

// After every write, in the parameter task; what it puts back is noted in GLUE.put_back.
void settings_touched(void);

#endif
