// ground.h - the thrust ratio over the ground, by the curve and the learner of the ceiling.
//
//   rho = rho_ceiling(zc) + rho_ground(h) - 1,   h the height of the feet above where they stand
//
// Between floor and ceiling the excesses add up (Jardin et al., thesis section 3.1.3). h counts from the
// feet, so that the bells of rbf.h lie where the vehicle can be: the legs keep its rotors away from the
// ground.
//
// The height is the estimator's; with the flow deck that is the distance downwards. A climb takes the vehicle
// out of the ground effect, which thus acts as a spring that pulls it back. The law predicts the spring's
// change over lag x climb (pos_indi.h), without `catch`, which is there for a spring that pushes. The
// prediction removes the spring's damping; if the curve is wrong, it removes at most GROUND_DAMPING of the
// law's own.
//
// Where both surfaces are near, the learners take turns: each would explain the whole of what both see.
#ifndef FLIGHT_GROUND_H
#define FLIGHT_GROUND_H

#include "flight/curve.h"
#include "flight/learn.h"
#include "flight/lpf2.h"
#include <stdbool.h>

// test: flight_bounds_what_the_grounds_curve_does_whatever_its_weights_are
#define GROUND_DAMPING 0.5f   // of the law's damping: half of it is left
#define GROUND_LEAST   -0.05f // lowest excess: half of the smallest ceil.ratioMin, so that no sum is 0

typedef struct {
  learn_t learn;
  lpf2_t filter;  // of the height; the filter of all signals of the outer loop
  float height_m; // of the feet above where they stand; valid only while known
  rbf_point_t at; // the curve at height_m; its slope is over the height
  bool known;
  // At the filtered height, which is of the instant of the learner's signals:
  float lesson_excess;   // ratio - 1 by the curve
  learn_sample_t sample; // for ground_learn; its zc_m is the filtered height
  float sample_excess;   // the ceiling's part of the sample's ratio
  bool turn;             // the ground learns next, not the ceiling
} ground_t;

// Inputs of one period.
typedef struct {
  float height_m;               // of the feet above where they stand, as it came in
  const learn_sample_t *sample; // of the same tick, its distance is ignored; null: nothing may be learned
  float excess;                 // of the ceiling at that sample: rho_ceiling - 1
  bool shared;                  // the ceiling's curve can learn from this sample, too
} ground_in_t;

// Starts the learned curve at `start`, with no height known. ST_BAD_PARAM, ST_BAD_INPUT: as rls_init.
MUST_CHECK status_t ground_init(ground_t *g, const learn_param_t *p, const rbf_weights_t *start);

// Runs one period, after the outer loop's: evaluates the curve, and keeps the sample that can be learned.
void ground_step(ground_t *g, const curve_param_t *c, const learn_param_t *p, const lpf2_coef_t *filter,
                 const ground_in_t *in);

// Learns from the sample that was kept, if it is the ground's turn. A call of its own, which replaces the
// ceiling's learning: both would be too much for one tick. Statuses as learn_update.
MUST_CHECK status_t ground_learn(ground_t *g, const learn_param_t *p);

// Forgets the height: it is not controlled, or calls were missed. The learned curve is kept.
void ground_rest(ground_t *g);

#endif
