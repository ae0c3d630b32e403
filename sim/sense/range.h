// range.h - the upward and downward range sensors (VL53L1) and the optical flow sensor (PMW3901) of the
// Multi-ranger and Flow decks, each with its rate, age, floor and noise.
//
// Source: Crazyflie firmware 2a18fc29 (rates, tasks, noise model, counts); thesis C.3 (floor). Upward: the
// task copies five sensors every 100 ms, so that a new sample is 60 to 80 ms old, and 160 to 180 ms old when
// the next one replaces it. Downward: 40 Hz, an exposure of 25 ms, whose middle counts as the instant. Flow:
// the angle by which the ground moved in 10 ms, in counts; the remainder of the rounding is carried over.
#ifndef SIM_SENSE_RANGE_H
#define SIM_SENSE_RANGE_H

#include "base/random.h"
#include "sense/truth.h"

#define RANGE_UP_PERIOD_MS   100
#define RANGE_UP_AGE_MIN_MS  60
#define RANGE_UP_AGE_MAX_MS  80
#define RANGE_UP_FLOOR_MM    40.0    // the upward sensor's reading at smaller distances
#define RANGE_UP_MAX_M       4.0     // beyond this it reads RANGE_UP_NOTHING_MM
#define RANGE_UP_NOTHING_MM  32767.0 // no valid distance
#define RANGE_DOWN_PERIOD_MS 25
#define RANGE_DOWN_AGE_MS    13
#define RANGE_DOWN_MAX_M     4.0   // beyond this the downward sensor reads RANGE_DOWN_NOTHING_M
#define RANGE_DOWN_NOTHING_M 8.191 // the driver passes no status on: beyond reach is merely far
#define RANGE_FLOW_PERIOD_MS 10
#define RANGE_ANY_PERIOD_MS  5                      // divides all periods
#define RANGE_COUNTS_PER_RAD (35.0 / 0.71674 / 0.1) // pixels over aperture, a tenth of a pixel per count
#define RANGE_FLOW_NEAREST_M 0.02                   // below this distance the flow grows no more

// All zero: perfect except for rate, age, floor and reach.
//
// A sample is (1 + scale) * distance + offset + noise; floor and reach are applied after that.
//
// With a cone, the sensor sees the nearest point of a level surface within that angle of its axis. At a tilt
// a, the slant distance is then 1 / cos(max(a - cone, 0)) times the height instead of 1 / cos a.
typedef struct {
  double up_m;   // sd of an upward sample
  double down_m; // sd of a downward sample near the ground; grows as in the firmware, twice that at 2.5 m
  double up_scale, down_scale;       // relative error of the scale: 0.01 reads 1 % too much
  double up_offset_m, down_offset_m; // constant error, added
  double up_cone_rad, down_cone_rad; // half angle; 0: the axis alone
  double flow_counts;                // sd of a flow sample, each axis
  double rounding;                   // above 0.5: whole millimetres and counts, as from the chips
} range_param_t;

#define RANGE_MEMORY 128 // ms; a power of two, more than the largest age

typedef struct {
  unsigned tick;                                   // of 1 ms
  double up_m[RANGE_MEMORY], down_m[RANGE_MEMORY]; // along the axis
  double upright[RANGE_MEMORY];                    // cosine of the tilt
  double up_mm;
  unsigned up_at;          // the tick at which the value now reported was true
  double moved_x, moved_y; // counts not yet delivered
} range_t;

typedef struct {
  bool up_new;
  double up_mm;  // 0 before the first sample; constant between samples
  int up_age_ms; // the truth, for tests: 60 to 180; 0 before the first
  bool down_new;
  double down_m;   // valid only when new
  int down_age_ms; // the truth, for tests
  bool flow_new;
  double flow_x, flow_y; // counts; valid only when new. Forward flight over still ground: x > 0
  double flow_span_s;    // the time over which they were counted
} range_sample_t;

void range_init(range_t *s);

// One period of 1 ms.
range_sample_t range_step(range_t *s, const range_param_t *p, random_t *r, const truth_t *truth);

// The same in two steps: draws the period's random numbers, whatever is seen, and makes samples from them.
// Numbers of sensors that have no new sample are meaningless.
typedef struct {
  double up_age_ms, up_error_m;
  double down; // of standard deviation 1
  double flow_x, flow_y;
} range_drawn_t;

range_drawn_t range_draw(const range_t *s, const range_param_t *p, random_t *r);
range_sample_t range_take(range_t *s, const range_param_t *p, const range_drawn_t *drawn,
                          const truth_t *truth);

#endif
