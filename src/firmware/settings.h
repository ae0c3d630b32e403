// settings.h - from parameters that are written one by one to sets that are flown as a whole.
//
// The parameters are the fields of GLUE.tuned. After every write the set is checked, in the parameter task;
// one that passes is flown as a whole from the next tick on. One that fails is counted, the last good one
// flies on, and what is out of its range gets its old value back. The weights ceil.w1..w7 wait for
// ceil.commit:
//   1  takes ceil.w1..w7 at once
//   2  copies the learned rls.w1..w7 into them, and takes those; refused while learning
// Either way learning goes on from there.
#ifndef FIRMWARE_SETTINGS_H
#define FIRMWARE_SETTINGS_H

#include <stdbool.h>
#include <stdint.h>

// A fresh controller with what the parameters say now, the weights included; defaults for what is refused.
void settings_start(void);

// Once a tick, before anything else; acts in every second one.
void settings_take(uint32_t step);

// A lesson may be taught now.
bool settings_learning(void);

// Called by the firmware's parameter task after every write.
void settings_touched(void);

#endif
