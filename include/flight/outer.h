// outer.h - the outer loop, 100 Hz, in the order in which it runs: position to direction and size of the
// thrust.
//
//   check inputs -> filter -> thrust -> ceiling distance -> curve -> learn -> position law
//
// One state per vehicle, all of it in outer_t. Nothing here stops, prints or allocates. An input
// that is not finite, or beyond what any indoor flight shows, changes nothing: the last command is given
// again and the fault is counted. A range sample that is no distance is counted and left out; the rest of
// that tick flies on.
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
  bool range_new;    // range_m is a sample that was not there at the last call
  float range_m;     // upward range sensor, from the sensor to what is above, along the body's z axis
  float range_age_s; // time since it was measured
  pos_setpoint_t setpoint;
} outer_in_t;

typedef struct {
  v3_t up_w;      // direction of thrust, world, length 1
  float thrust_N; // of all motors together
  float zc_m;     // ceiling distance; has a meaning only while zc_known
  bool zc_known;
  rbf_point_t at;    // value, the ground's share with it, and slope of the ceiling's curve that were used
  float ceiling_z_m; // height of the ceiling (hold.h, latched where ceil.hold says so); NaN: none known
} outer_out_t;

// Where the top of the body may touch: it is 7 to 10 mm above the propellers, and the estimate is off by 3
// mm. Farther off nothing holds the vehicle, and a wrong curve or mass that looks like a push costs nothing.
#define OUTER_TOUCH_M    0.014f
#define OUTER_STILL_MPS  0.03f  // what sinks faster pushes against nothing
#define OUTER_CLIP_M     0.006f // a height beyond ceil.min is flown so far below it
#define OUTER_REPEATED_M 0.01f  // after a climb of so much the same range again is no measurement
#define FLOOR_SHARE      0.5f   // of the weight that something else than the rotors carries: a floor
#define OUTER_CARRYING_S 100.0f // longer than rls.after can ask for
#define OUTER_MISSED_MAX 1000   // ticks; nobody flies on after so many

// What the ground makes of the thrust ratio (ground.h); all 0 where nobody looks.
typedef struct {
  float excess;        // rho_ground - 1
  float pull_per_s2;   // acceleration that a hover loses per height climbed: -g / rho d rho_ground / d h
  float lesson_excess; // rho_ground - 1 at the instant of the signals that are learned from, a period ago
} outer_ground_t;

typedef struct {
  sync_coef_t coef;
  bias_coef_t bias_coef; // of one period
  // What the height is flown by: the parameters' and the estimator's, or by an own height.
  pos_indi_param_t law;
  float lag_s;     // pos_indi.h: of one law, at these parameters
  float gap_min_m; // against the estimator's height
  float less_mps;  // than the estimator's climb
  sync_t sync;
  sync_out_t signals; // of the last step
  bias_t bias;
  hold_t hold;
  float height_last_m;
  float range_last_m, range_height_m; // the last range that was another one, and the height it came at
  float carrying_s;                   // time since the rotors began to carry
  bool started, at_limit;
  learn_sample_t sample; // what the last step has for the learner
  bool sample_new;       // it has not been learned from yet
  outer_ground_t ground;
  outer_out_t out;
  unsigned faults[ST_COUNT]; // how often each status came up
  unsigned missed;           // ticks since the last good input
  // The large ones last, so that the rest stays within reach of one instruction.
  flight_param_t param; // the last parameters that passed their checks
  ceiling_t ceiling;
  learn_t learn;
} outer_t;

// A controller that has not seen a sample yet; it starts bumplessly from the first one. period_s: 0.001..0.1.
// The curve that is learned starts at p's fixed weights (ceil.w1..w7).
// ST_BAD_PARAM: period_s or a parameter out of range; *f is kept.
MUST_CHECK status_t outer_init(outer_t *f, const flight_param_t *p, float period_s);

// Other parameters from the next step on, in flight as well; the signals keep their history. ST_BAD_PARAM:
// one is out of range, or the cut-off at this period; counted, and the last good set flies on.
MUST_CHECK status_t outer_tune(outer_t *f, const flight_param_t *p);

// The same for a set that has passed params_check(), within a tick: nothing is checked or counted but the
// cut-off.
MUST_CHECK status_t outer_take(outer_t *f, const flight_param_t *p);

// One period. The result is f->out.
const outer_out_t *outer_step(outer_t *f, const outer_in_t *in);

// The next step's height and climb are by->more_m and by->more_mps more than in has them, with by's gains. A
// height that is more is a set point that is less: that is the caller's to do. Until then, or outer_take().
void outer_fly_by(outer_t *f, const height_fly_t *by);

// The next step is flown by what in has, with the parameters' gains.
void outer_fly_by_estimate(outer_t *f);

// From now on the acceleration comes with this much more of bias along the world's z. What the observer can
// hold is taken over without a bump, and is the result: 0 before the first step, or where no bias is looked
// for.
float outer_take_bias(outer_t *f, float more_mps2);

// Teaches the curve what the last step measured, if it may (ceil.mode 2). A call of its own, so that it can
// run in another tick than the step; without effect if there was no step since.
void outer_learn(outer_t *f);

// Between two steps: signals that are no numbers any more (a flipped bit) start afresh from the last step's
// input, and are counted (ST_BAD_STATE). What else was learned in flight, as the bias, stays.
void outer_scrub(outer_t *f, const outer_in_t *in);

// So many more periods without a step.
static inline void outer_miss(outer_t *f, unsigned ticks) {
  f->missed = EITHER(f->missed + ticks < OUTER_MISSED_MAX, f->missed + ticks, OUTER_MISSED_MAX);
}

// Something else than the rotors carries: a floor, a hand.
static inline bool outer_on_floor(const outer_t *f) {
  return f->sample.force_N - f->sample.thrust_N > FLOOR_SHARE * f->sample.weight_N;
}

// Until its next step nobody knows what the ground gives.
static inline void outer_lose_ground(outer_t *f) {
  f->ground = (outer_ground_t){.excess = 0.0f};
}

// On the ground, or with the height not controlled: filters, thrust state and ceiling estimate start afresh
// with the next step. What was learned is kept.
void outer_rest(outer_t *f);

#endif
