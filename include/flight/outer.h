// outer.h - the outer loop, 100 Hz, in the order in which it runs: position to direction and size of the
// thrust.
//
//   check inputs -> filter -> thrust -> ceiling distance -> curve -> learn -> position law
//
// One state per vehicle, all of it in outer_t. Nothing here stops, prints or allocates. An input that is not
// finite, or beyond what any indoor flight shows, changes nothing: the last command is given again and the
// fault is counted. A range sample that is not a distance is counted and ignored; the rest of that tick runs.
#ifndef FLIGHT_OUTER_H
#define FLIGHT_OUTER_H

#include "flight/ceiling.h"
#include "flight/height.h"
#include "flight/hold.h"
#include "flight/learn.h"
#include "flight/params.h"
#include "flight/pos_indi.h"
#include "flight/status.h"
#include "flight/sync.h"
#include "flight/v3.h"

typedef struct {
  v3_t pos_w_m;
  v3_t vel_w_mps;
  v3_t acc_b_mps2;   // specific force: +9.81 on z at rest
  quat_t q_wb;       // attitude, body to world
  float thrust_N;    // what was applied since the last call: the command after mixing and limits
  bool range_new;    // range_m is a new sample since the last call
  float range_m;     // upward range sensor, from the sensor to what is above, along the body's z axis
  float range_age_s; // time since it was measured
  pos_setpoint_t setpoint;
} outer_in_t;

typedef struct {
  v3_t up_w;      // direction of thrust, world, length 1
  float thrust_N; // of all motors together
  float zc_m;     // ceiling distance; valid only while zc_known
  bool zc_known;
  rbf_point_t at;    // in use: ratio with the ground's share, slope of the ceiling's curve alone
  float ceiling_z_m; // height of the ceiling (hold.h, latched where ceil.hold says so); NaN: none known
} outer_out_t;

// Nearer than this the top of the body may touch: it is 7 to 10 mm above the propellers, and the estimate is
// off by 3 mm. Farther away there is no contact, and a wrong curve or mass that looks like a push must not
// limit the thrust.
#define OUTER_TOUCH_M    0.014f
#define OUTER_STILL_MPS  0.03f  // a vehicle that sinks faster does not push against the ceiling
#define OUTER_CLIP_M     0.006f // a height set point beyond ceil.min is flown up to this far below it
#define OUTER_REPEATED_M 0.01f  // after moving this far, an unchanged range is not a measurement
#define FLOOR_SHARE      0.5f   // of the weight: if something other than the rotors carries it, it is a floor
#define OUTER_CARRYING_S 100.0f // longer than rls.after can ask for
#define OUTER_MISSED_MAX 1000   // ticks; no flight goes on after so many

// The ground's part of the thrust ratio (ground.h); all 0 if ground.mode is off or the part is not known.
typedef struct {
  float excess;        // rho_ground - 1
  float pull_per_s2;   // acceleration that a hover loses per height climbed: -g / rho d rho_ground / d h
  float lesson_excess; // rho_ground - 1 at the instant of the learner's signals, a period ago
} outer_ground_t;

typedef struct {
  sync_coef_t coef;
  bias_coef_t bias_coef; // of one period
  // How the height is flown: with the parameters and the estimator's height, or with the height filter's.
  pos_indi_param_t law;
  float lag_s;     // lag of pos_indi.h, for this law and these parameters
  float gap_min_m; // ceil.min, referred to the estimator's height
  float less_mps;  // the climb rate in use is this much less than the estimator's
  sync_t sync;
  sync_out_t signals; // of the last step
  bias_t bias;
  hold_t hold;
  float height_last_m;
  float range_last_m, range_height_m; // the last range that differed from its predecessor; the height then
  float carrying_s;                   // time since the rotors began to carry the vehicle
  bool started, at_limit;
  learn_sample_t sample; // of the last step, for the learner
  bool sample_new;       // the learner has not seen it yet
  outer_ground_t ground;
  outer_out_t out;
  unsigned faults[ST_COUNT]; // how often each status came up
  unsigned missed;           // ticks since the last good input
  // Large members last, so that one instruction can address the others.
  flight_param_t param; // the last parameters that passed their checks
  ceiling_t ceiling;
  learn_t learn;
} outer_t;

// Initialises a controller, which then starts bumplessly from its first sample. period_s: 0.001..0.1. The
// learned curve starts at p's fixed weights (ceil.w1..w7).
// ST_BAD_PARAM: period_s or a parameter out of range; *f is kept.
MUST_CHECK status_t outer_init(outer_t *f, const flight_param_t *p, float period_s);

// Uses the parameters *p from the next step on, also in flight; the signals keep their history. ST_BAD_PARAM:
// a parameter is out of range, or the cut-off is at this period; counted, and the last good set stays in use.
MUST_CHECK status_t outer_tune(outer_t *f, const flight_param_t *p);

// As outer_tune, for a set that has passed params_check(), and short enough for a tick: checks only the
// cut-off, and counts nothing.
MUST_CHECK status_t outer_take(outer_t *f, const flight_param_t *p);

// Runs one period and returns f->out.
const outer_out_t *outer_step(outer_t *f, const outer_in_t *in);

// From the next step on, height and climb rate are larger than the input's by by->more_m and by->more_mps,
// with the gains of *by. The caller has to lower the height's set point by more_m instead. Holds until the
// next outer_fly_by, outer_fly_by_estimate or outer_take.
void outer_fly_by(outer_t *f, const height_fly_t *by);

// From the next step on, uses the input's height and climb rate with the parameters' gains.
void outer_fly_by_estimate(outer_t *f);

// Tells the bias observer that from now on the acceleration contains more_mps2 more of bias along the world's
// z. Returns the part that the observer can hold, which it takes over without a bump: 0 before the first
// step, or if no bias is estimated.
float outer_take_bias(outer_t *f, float more_mps2);

// Updates the learned curve with the last step's sample, if ceil.mode is 2. A call of its own, so that it can
// run in another tick than the step; no effect if there was no step since the last call.
void outer_learn(outer_t *f);

// Call between two steps. If a flipped bit has spoilt the filtered signals, restarts them from *in, the last
// step's input, and counts that (ST_BAD_STATE). What was learned in flight, e.g. the bias, stays.
void outer_scrub(outer_t *f, const outer_in_t *in);

// Counts that many more periods without a step.
static inline void outer_miss(outer_t *f, unsigned ticks) {
  f->missed = EITHER(f->missed + ticks < OUTER_MISSED_MAX, f->missed + ticks, OUTER_MISSED_MAX);
}

// True if something other than the rotors carries the vehicle: a floor, a hand.
static inline bool outer_on_floor(const outer_t *f) {
  return f->sample.force_N - f->sample.thrust_N > FLOOR_SHARE * f->sample.weight_N;
}

// Sets the ground's part to not known, until it is next computed.
static inline void outer_lose_ground(outer_t *f) {
  f->ground = (outer_ground_t){.excess = 0.0f};
}

// Call on the ground, or while the height is not controlled: filters, thrust state and ceiling estimate start
// afresh with the next step. What was learned is kept.
void outer_rest(outer_t *f);

#endif
