// hold.h - the ceiling's height in the world (thesis C.3).
//
//   the first HOLD_SAMPLES            mean of z + sample; a take-off close below the ceiling has no others
//   then, HOLD_MEAN                   the mean goes on, over samples that come at a climb or sink rate below
//                                     HOLD_SLOW_MPS; from HOLD_MEAN_SAMPLES on with 1/HOLD_MEAN_SAMPLES each
//   then, HOLD_LATCHED, the thesis's  farther than HOLD_BEYOND_M: z + zc, the estimate; nearer: unchanged
//   always, HOLD_NOT                  z + zc
//
// A latched height keeps the estimate's error of that instant, 0.8 mm (the sensor's 3 mm times 0.229); of the
// noise of 70 samples, 0.3 mm remain in their mean. A sample that comes while the vehicle climbs does not
// count: if its age is uncertain by 10 ms, it is wrong by the climb of 10 ms. A range sensor may be wrong by
// 1 % of its reading, so samples from 20 cm away must be forgotten by the time the ceiling is seen from 6 cm
// (at noise level `flown`, 20 mm below the ceiling, the mean error of a flight is 1.9 mm with 70 samples, 2.1
// mm with 200, and no less with 30).
//
// The held height may become wrong: another room, a beam, a hole in the ceiling. If samples contradict it by
// more than HOLD_MARGIN_M for HOLD_AGAINST_S, it restarts from the last one, or is forgotten if the estimate
// knows no ceiling. A higher ceiling is believed only if it is farther away than HOLD_ROOM_M.
#ifndef FLIGHT_HOLD_H
#define FLIGHT_HOLD_H

#include "flight/ceiling.h"
#include <stdint.h>

#define HOLD_BEYOND_M     0.20f
#define HOLD_SAMPLES      10
#define HOLD_MEAN_SAMPLES 70     // 7 s: longer than a hover wanders, short enough to follow near samples
#define HOLD_SLOW_MPS     0.05f  // 0.5 mm in 10 ms
#define HOLD_NOISE_M      0.012f // four standard deviations of a sample
#define HOLD_MARGIN_M     0.05f
#define HOLD_AGAINST_S    0.295f // 0.3 less the rounding of thirty ticks
#define HOLD_AGAINST      3      // samples at least
#define HOLD_ROOM_M       0.15f  // a higher ceiling is at least this far away

typedef enum { HOLD_NOT, HOLD_LATCHED, HOLD_MEAN } hold_mode_t;

typedef struct {
  float ceiling_z_m; // NaN: none known
  int samples;       // in the mean, up to HOLD_MEAN_SAMPLES
  int against;       // samples in a row that contradict, up to HOLD_AGAINST
  float against_s;   // since the first of them
} hold_t;

// No ceiling known.
void hold_init(hold_t *s);

// Advances by period_s, to height z_m (finite). mode: hold_mode_t; with any other value the height stays
// after the first HOLD_SAMPLES.
void hold_step(hold_t *s, const ceiling_t *c, float z_m, float period_s, int32_t mode);

// Takes the sample that the estimate has just taken (ceiling_correct gave ST_OK), at height z_m and climb
// rate climb_mps.
void hold_sample(hold_t *s, const ceiling_t *c, float z_m, float climb_mps, int32_t mode);
// The same where `is` holds (ceiling_take).
void hold_take(hold_t *s, const ceiling_t *c, bool is, float z_m, float climb_mps, int32_t mode);

#endif
