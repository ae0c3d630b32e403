// ceiling.h - distance to the ceiling at 100 Hz from a 10 Hz range sensor (thesis algorithm 1).
//
//   each tick:        zc -= climb                       the ceiling stays, the vehicle moves
//   each new sample:  zc += gain (range - zc_then)      zc_then: what zc was when the sample was measured
//
// The sensor has a floor of 4 cm: samples below floor_m are dropped, and an estimate below near_m lives on
// climb alone. The thesis gates on the estimate and nothing else, so that an estimate that is wrongly near is
// never corrected again. Here three samples in a row that agree with each other set it right: beyond near_m
// and 2 cm farther than the estimate, or at the floor while the estimate is beyond near_m (src/README.md,
// reading rules). An estimate that is not gated believes at once what is CEILING_JUMP_M nearer, a beam, and
// three times what is as much farther, a hole. floor_m lies well below near_m: to drop the near half of the
// noise at the gate pushes the estimate up (measured: 1 mm). With gain 0.1 at 10 Hz: time constant 0.95 s,
// white noise of the sensor times 0.229.
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

// Ticks of climb that are remembered, and so the oldest sample that can be used. A power of two, or an index
// that wraps below 0 would be another.
#define CEILING_HISTORY     32
#define CEILING_RANGE_MIN_M 0.01f // the sensor ends at 4 cm: below this it speaks another unit
#define CEILING_RANGE_MAX_M 4.0f  // the sensor's range; 32.767 m is its word for "no echo"
// A sample that is nearer by this is taken at once, one that is farther as a rival.
#define CEILING_JUMP_M      0.05f
#define CEILING_AGREE_M     0.02f // samples agree when they are within this of their mean, else they contradict
#define CEILING_AGREE_COUNT 3     // agreeing samples that overrule the estimate

typedef struct {
  float zc_m;     // m, 0..far_m: propeller plane to ceiling; has a meaning only while `known`
  bool known;     // a ceiling is in sight
  float blind_s;  // time since the last sample that was taken in
  float seen_m;   // the last sample that was a distance: what it meant when it came
  float period_s; // of ceiling_predict
  bool tilt_known;
  unsigned newest;                 // index into both
  float rival_m;                   // mean of the samples that contradict the estimate, moved along with it
  int rivals;                      // how many of them in a row
  float climbs_m[CEILING_HISTORY]; // ring: the last climbs
  float ups[CEILING_HISTORY];      // ring: cosine of the tilt at those ticks, as ceiling_tilt gave it
} ceiling_t;

// No ceiling in sight. period_s: time between two calls of ceiling_predict, > 0.
void ceiling_init(ceiling_t *s, float period_s);

// The vehicle climbed by climb_m (finite) since the last call; the ceiling did not move.
void ceiling_predict(ceiling_t *s, const ceiling_param_t *p, float climb_m);

// The same over several periods (>= 1) of which nothing else is known: the vehicle climbed evenly.
void ceiling_predict_over(ceiling_t *s, const ceiling_param_t *p, float climb_m, int periods);

// The cosine of the tilt at the last ceiling_predict. Before the first call it was the same for ever; between
// calls it stays.
void ceiling_tilt(ceiling_t *s, float up);

// The cosine of the tilt age_s ago, by which a slant range that was measured then is longer than the vertical
// one. 1 if none was given. An age that is none counts as 0, one beyond the history as its end.
float ceiling_up(const ceiling_t *s, float age_s);

// A new range sample, vertical (tilt taken out), measured age_s ago (0..(CEILING_HISTORY - 1) periods; older
// ones are treated as that old).
// ST_BAD_RANGE: not finite, not positive or beyond CEILING_RANGE_MAX_M, or an age that is not finite or
// negative; the estimate is kept.
MUST_CHECK status_t ceiling_correct(ceiling_t *s, const ceiling_param_t *p, float range_m, float age_s);

// The same in two: whether a sample is one, and what it changes where `is` holds. Of vehicles that fly side
// by side some have a sample that others have not (EITHER of flight/v3.h). Whether it is one (range_m within
// 0..CEILING_RANGE_MAX_M, age_s not negative and finite) has to be asked before: ceiling_take() does not.
bool ceiling_good(float range_m, float age_s);
void ceiling_take(ceiling_t *s, const ceiling_param_t *p, bool is, float range_m, float age_s);

#endif
