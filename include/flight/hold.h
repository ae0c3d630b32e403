// hold.h - the ceiling's height in the world (thesis C.3).
//
//   the first HOLD_SAMPLES              mean of z + sample; a take-off close below it has seen no others
//   then, HOLD_MEAN                     the mean goes on, over samples that came while climbing or sinking
//   slower
//                                       than HOLD_SLOW_MPS; from HOLD_MEAN_SAMPLES on it follows at that rate
//   then, HOLD_LATCHED, the thesis's    farther than HOLD_BEYOND_M: z + zc, the estimate; nearer: what it was
//   always, HOLD_NOT                    z + zc
//
// A latched height keeps the estimate's error of that instant, 0.8 mm (the sensor's 3 mm times 0.229); the
// mean of 70 has 0.3 mm of the noise left. While it climbs, a sample whose age is not known to 10 ms is
// wrong by a tenth of that in speed: it does not count then. A range sensor may be wrong by 1 % of what it
// says: what was seen from 20 cm is to be forgotten when it is seen from 6 cm (at `flown`, 20 mm below the
// ceiling, each flight's own mean error is 1.9 mm; 2.1 mm with 200, and no less with 30).
//
// What is held may have become wrong: another room, a beam, a hole in the ceiling. Samples that put it
// elsewhere by more than HOLD_MARGIN_M for HOLD_AGAINST_S make it start afresh, or forgotten where the
// estimate knows no ceiling. A higher one is believed only where there is room.
#ifndef FLIGHT_HOLD_H
#define FLIGHT_HOLD_H

#include "flight/ceiling.h"
#include <stdint.h>

#define HOLD_BEYOND_M     0.20f
#define HOLD_SAMPLES      10
#define HOLD_MEAN_SAMPLES 70     // 7 s: longer than a hover wanders, and soon of what is seen from near
#define HOLD_SLOW_MPS     0.05f  // 0.5 mm in 10 ms
#define HOLD_NOISE_M      0.012f // four standard deviations of a sample
#define HOLD_MARGIN_M     0.05f
#define HOLD_AGAINST_S    0.295f // 0.3 less the rounding of thirty ticks
#define HOLD_AGAINST      3      // samples at least
#define HOLD_ROOM_M       0.15f  // a higher ceiling is at least so far away

typedef enum { HOLD_NOT, HOLD_LATCHED, HOLD_MEAN } hold_mode_t;

typedef struct {
  float ceiling_z_m; // NaN: none known
  int samples;       // that made it, up to HOLD_MEAN_SAMPLES
  int against;       // samples in a row that contradict, up to HOLD_AGAINST
  float against_s;   // since the first of them
} hold_t;

// No ceiling known.
void hold_init(hold_t *s);

// period_s later, at height z_m (finite). mode: hold_mode_t; of another nothing follows.
void hold_step(hold_t *s, const ceiling_t *c, float z_m, float period_s, int32_t mode);

// The estimate has just looked at a sample (ceiling_correct gave ST_OK) at height z_m, climbing by climb_mps.
void hold_sample(hold_t *s, const ceiling_t *c, float z_m, float climb_mps, int32_t mode);
// The same where `is` holds (ceiling_take).
void hold_take(hold_t *s, const ceiling_t *c, bool is, float z_m, float climb_mps, int32_t mode);

#endif
