// range.h - the upward and downward range sensors (VL53L1) and the optical flow sensor (PMW3901) of the
// Multi-ranger and Flow decks, each with its rate, age, floor and noise.
//
// Source: Crazyflie firmware 2a18fc29 (rates, tasks, noise model, counts); thesis C.3 (floor). Upward: the
// task copies five sensors every 100 ms, so that a new sample is 60 to 80 ms old, and 160 to 180 ms old when
// the next one replaces it. Downward: 40 Hz, 25 ms of exposure, its middle taken as the instant. Flow: the
// angle that the ground moved through during 10 ms, in counts, rounded without losing the rest.
#ifndef SIM_SENSE_RANGE_H
#define SIM_SENSE_RANGE_H

#include "base/random.h"
#include "sense/truth.h"

#define RANGE_UP_PERIOD_MS   100
#define RANGE_UP_AGE_MIN_MS  60
#define RANGE_UP_AGE_MAX_MS  80
#define RANGE_UP_FLOOR_MM    40.0    // nearer than this the upward sensor says this
#define RANGE_UP_MAX_M       4.0     // farther than this it says RANGE_UP_NOTHING_MM
#define RANGE_UP_NOTHING_MM  32767.0 // no valid distance
#define RANGE_DOWN_PERIOD_MS 25
#define RANGE_DOWN_AGE_MS    13
#define RANGE_DOWN_MAX_M     4.0   // farther than this the downward sensor says RANGE_DOWN_NOTHING_M
#define RANGE_DOWN_NOTHING_M 8.191 // the driver passes no status on: what is beyond reach is just far
#define RANGE_FLOW_PERIOD_MS 10
#define RANGE_ANY_PERIOD_MS  5                      // divides them all
#define RANGE_COUNTS_PER_RAD (35.0 / 0.71674 / 0.1) // pixels over aperture, a tenth of a pixel a count
#define RANGE_FLOW_NEAREST_M 0.02                   // nearer than this the flow grows no more

// All zero: perfect but for rate, age, floor and reach.
//
// A sample is (1 + scale) * distance + offset + noise; floor and reach come after.
//
// A cone: the sensor sees the nearest point of a level surface within that angle of its axis. The slant of
// tilt a is then 1 / cos(max(a - cone, 0)) of the height instead of 1 / cos a.
typedef struct {
  double up_m;   // sd of an upward sample
  double down_m; // sd of a downward sample near the ground; grows as the firmware says, twice at 2.5 m
  double up_scale, down_scale;       // relative error of the scale: 0.01 reads 1 % too much
  double up_offset_m, down_offset_m; // constant error, besides
  double up_cone_rad, down_cone_rad; // half the angle; 0: the axis alone
  double flow_counts;                // sd of a flow sample, each axis
  double rounding;                   // above 0.5: whole millimetres and counts, as the chips deliver
} range_param_t;

#define RANGE_MEMORY 128 // ms; a power of two, more than the greatest age

typedef struct {
  unsigned tick;                                   // of 1 ms
  double up_m[RANGE_MEMORY], down_m[RANGE_MEMORY]; // along the axis
  double upright[RANGE_MEMORY];                    // cosine of the tilt
  double up_mm;
  unsigned up_at;          // tick at which what is now reported was true
  double moved_x, moved_y; // counts not yet delivered
} range_t;

typedef struct {
  bool up_new;
  double up_mm;  // 0 before the first sample; holds until the next
  int up_age_ms; // the truth, for tests: 60 to 180; 0 before the first
  bool down_new;
  double down_m;   // has a meaning only when new
  int down_age_ms; // the truth, for tests
  bool flow_new;
  double flow_x, flow_y; // counts; has a meaning only when new. Forward flight over still ground: x > 0
  double flow_span_s;    // what they were counted over
} range_sample_t;

void range_init(range_t *s);

// One period of 1 ms.
range_sample_t range_step(range_t *s, const range_param_t *p, random_t *r, const truth_t *truth);

// The same in two steps: what the period draws, whatever is seen, and what it makes of it. Of those sensors
// that have nothing new the numbers have no meaning.
typedef struct {
  double up_age_ms, up_error_m;
  double down; // of standard deviation 1
  double flow_x, flow_y;
} range_drawn_t;

range_drawn_t range_draw(const range_t *s, const range_param_t *p, random_t *r);
range_sample_t range_take(range_t *s, const range_param_t *p, const range_drawn_t *drawn,
                          const truth_t *truth);

#endif
