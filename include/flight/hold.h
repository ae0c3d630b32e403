// hold.h - the ceiling's height in the world (thesis C.3).
//
//   the first HOLD_SAMPLES              mean of z + sample; a take-off close below it has seen no others
//   then, farther than HOLD_BEYOND_M    z + zc, the estimate
//   then, nearer                        what it was: the estimate lives on climb and noise there
//
// What is held may have become wrong: another room, a beam, a hole in the ceiling. Samples that put it
// elsewhere by more than HOLD_MARGIN_M for HOLD_AGAINST_S make it start afresh, or forgotten where the
// estimate knows no ceiling. A higher one is believed only where there is room.
#ifndef FLIGHT_HOLD_H
#define FLIGHT_HOLD_H

#include "flight/ceiling.h"

#define HOLD_BEYOND_M  0.20f
#define HOLD_SAMPLES   10
#define HOLD_MARGIN_M  0.05f
#define HOLD_AGAINST_S 0.295f // 0.3 less the rounding of thirty ticks
#define HOLD_AGAINST   3      // samples at least
#define HOLD_ROOM_M    0.15f  // a higher ceiling is at least so far away

typedef struct {
  float ceiling_z_m; // NaN: none known
  int samples;       // that made it, up to HOLD_SAMPLES
  int against;       // samples in a row that contradict, up to HOLD_AGAINST
  float against_s;   // since the first of them
} hold_t;

// No ceiling known.
void hold_init(hold_t *s);

// period_s later, at height z_m (finite). latch: false takes z + zc always.
void hold_step(hold_t *s, const ceiling_t *c, float z_m, float period_s, bool latch);

// The estimate has just looked at a sample (ceiling_correct gave ST_OK) at height z_m.
void hold_sample(hold_t *s, const ceiling_t *c, float z_m);

#endif
