// ground.h - the thrust ratio over the ground, by the curve and the learner of the ceiling.
//
//   rho = rho_ceiling(zc) + rho_ground(h) - 1,   h the height of the feet above where they stand
//
// In a channel the excesses add up (Jardin et al., thesis section 3.1.3). Counted from the feet the bells of
// rbf.h lie where a vehicle can be: its rotors never come nearer to the ground than its legs let them.
//
// The height is the estimator's: that of the flow deck is the distance downwards. A climb takes the vehicle
// out of the effect, a spring that pulls back; what the law foretells of it is lag x climb (pos_indi.h), and
// no `catch`, which is there for a spring that pushes. What is foretold takes the spring's damping out, and
// takes GROUND_DAMPING of the law's at most where the curve is wrong.
//
// Where both surfaces are near, the two learners take turns: each would explain the whole of what both see.
#ifndef FLIGHT_GROUND_H
#define FLIGHT_GROUND_H

#include "flight/curve.h"
#include "flight/learn.h"
#include "flight/lpf2.h"
#include <stdbool.h>

// test: flight_bounds_what_the_grounds_curve_does_whatever_its_weights_are
#define GROUND_DAMPING 0.5f   // of the law's: half of it is left
#define GROUND_LEAST   -0.05f // of the excess: half of the smallest ceil.ratioMin, so that no sum is 0

typedef struct {
  learn_t learn;
  lpf2_t filter;  // of the height, as all signals of the outer loop have it
  float height_m; // of the feet above where they stand; has a meaning only while known
  rbf_point_t at; // what the curve says there; the slope is over the height
  bool known;
  // Of the instant of what is learned from, at the filtered height.
  float lesson_excess;   // what the curve says, ratio - 1
  learn_sample_t sample; // what can be learned; zc_m is that height
  float sample_excess;   // of its ratio, what the ceiling gives
  bool turn;             // the next lesson is the ground's
} ground_t;

// What one period has for it.
typedef struct {
  float height_m;               // of the feet above where they stand, as it came in
  const learn_sample_t *sample; // of the same tick, its distance of no use; null: nothing may be learned
  float excess;                 // what the ceiling gives at that sample: rho_ceiling - 1
  bool shared;                  // the ceiling's curve learns from such a sample, too
} ground_in_t;

// Knows no height yet; the curve that is learned starts at `start`. ST_BAD_PARAM, ST_BAD_INPUT: as rls_init.
MUST_CHECK status_t ground_init(ground_t *g, const learn_param_t *p, const rbf_weights_t *start);

// One period, after the outer loop's: looks at the curve, and keeps what can be learned.
void ground_step(ground_t *g, const curve_param_t *c, const learn_param_t *p, const lpf2_coef_t *filter,
                 const ground_in_t *in);

// Learns what was kept, if it is the ground's turn. A call of its own, in place of the ceiling's lesson: both
// in one tick would be too much. Statuses as learn_update.
MUST_CHECK status_t ground_learn(ground_t *g, const learn_param_t *p);

// Nobody knows the height: it is not controlled, or calls were missed. What was learned is kept.
void ground_rest(ground_t *g);

#endif
