// ceiling.h - distance to the ceiling at 100 Hz from a 10 Hz range sensor (thesis algorithm 1).
//
//   each tick:        zc -= climb                       the ceiling stays, the vehicle moves
//   each new sample:  zc += gain (range - zc_then)      zc_then: zc when the sample was measured
//
// The sensor cannot measure below 4 cm: samples below floor_m are dropped, and an estimate below near_m is
// gated, that is, it follows the climb alone. The thesis gates on nothing but the estimate, so that an
// estimate that is wrongly near is never corrected. Here three samples in a row that agree with each other
// overrule it: samples beyond near_m and 2 cm farther than a gated estimate, or samples at the floor while
// the estimate is beyond near_m (src/README.md, reading rules). An estimate that is not gated takes a sample
// that is nearer by CEILING_JUMP_M (a beam) at once, and one that is farther by as much (a hole) after three.
// floor_m lies well below near_m, because dropping the near half of the noise at the gate makes the estimate
// too large (measured: by 1 mm). With gain 0.1 at 10 Hz the time constant is 0.95 s, and the white noise of
// the sensor is multiplied by 0.229.
#ifndef FLIGHT_CEILING_H
#define FLIGHT_CEILING_H

#include "flight/status.h"
#include <stdbool.h>

typedef struct {
  float gain;    // 0..1       share of the range error taken in per sample
  float floor_m; // >= 0      samples below this are the sensor's floor, not a distance
  float near_m;  // >= floor_m an estimate nearer than this is not corrected
  float far_m;   // > near_m   farther than this there is no ceiling
} ceiling_param_t;

// Ticks of climb that are remembered, and so the largest age of a sample. A power of two, so that an unsigned
// index that wraps below 0 stays right.
#define CEILING_HISTORY     32
#define CEILING_RANGE_MIN_M 0.01f // the sensor ends at 4 cm: a smaller value is in another unit
#define CEILING_RANGE_MAX_M 4.0f  // the sensor's range; it gives 32.767 m for "no echo"
// A sample that is nearer than the estimate by this is taken at once; one that is farther by this is a rival.
#define CEILING_JUMP_M 0.05f
// Rivals within this of their mean agree; a gated estimate has rivals that are farther than it by this.
#define CEILING_AGREE_M     0.02f
#define CEILING_AGREE_COUNT 3 // agreeing samples that overrule the estimate

typedef struct {
  float zc_m;     // 0..far_m: propeller plane to ceiling; valid only while `known`
  bool known;     // a ceiling is in sight
  float blind_s;  // time since the estimate last accepted a sample
  float seen_m;   // the last valid sample, moved by the climb from its measurement to its arrival
  float period_s; // of ceiling_predict
  bool tilt_known;
  unsigned newest;                 // index into both rings
  float rival_m;                   // mean of the samples that contradict the estimate, moved by the climb
  int rivals;                      // their number, in a row
  float climbs_m[CEILING_HISTORY]; // ring: the last climbs
  float ups[CEILING_HISTORY];      // ring: cosine of the tilt at those ticks, as ceiling_tilt gave it
} ceiling_t;

// No ceiling in sight. period_s: time between two calls of ceiling_predict, > 0.
void ceiling_init(ceiling_t *s, float period_s);

// The vehicle climbed by climb_m (finite) since the last call; the ceiling did not move.
void ceiling_predict(ceiling_t *s, const ceiling_param_t *p, float climb_m);

// As ceiling_predict, over several periods (>= 1): assumes that the vehicle climbed evenly.
void ceiling_predict_over(ceiling_t *s, const ceiling_param_t *p, float climb_m, int periods);

// Records `up`, the cosine of the tilt at the last ceiling_predict. The first call fills the whole history;
// ticks without a call repeat the last value.
void ceiling_tilt(ceiling_t *s, float up);

// Returns the cosine of the tilt age_s ago: vertical over slant range of a sample measured then. 1 if no tilt
// was recorded. A negative age or NaN counts as 0, an age beyond the history as its end.
float ceiling_up(const ceiling_t *s, float age_s);

// Takes a new range sample, vertical (without the tilt), measured age_s ago (0..(CEILING_HISTORY - 1)
// periods; older ones are treated as that old).
// ST_BAD_RANGE: not finite, not positive or beyond CEILING_RANGE_MAX_M, or an age that is not finite or
// negative; the estimate is kept.
MUST_CHECK status_t ceiling_correct(ceiling_t *s, const ceiling_param_t *p, float range_m, float age_s);

// ceiling_correct in two parts, for vehicles that are computed side by side (EITHER of flight/v3.h), of which
// some have a sample and others do not. ceiling_good: true if the sample is valid (range_m above 0 and at
// most CEILING_RANGE_MAX_M, age_s finite and not negative). ceiling_take takes the sample where `is` holds;
// it does not check it.
bool ceiling_good(float range_m, float age_s);
void ceiling_take(ceiling_t *s, const ceiling_param_t *p, bool is, float range_m, float age_s);

#endif
