// ground.h - the thrust ratio over the ground, by the curve and the learner of the ceiling.
//
//   rho = rho_ceiling(zc) + rho_ground(h) - 1,   h the height of the feet above where they stand
//
// In a channel the excesses add up (Jardin et al., thesis section 3.1.3). Counted from the feet the bells of
// rbf.h lie where a vehicle can be: its rotors never come nearer to the ground than its legs let them.
//
// The height is the estimator's: that of the flow deck is the distance downwards. A climb takes the vehicle
// out of the effect, a spring that pulls back; what the law foretells of it is lag x climb (pos_indi.h), and
// no `catch`, which is there for a spring that pushes.
//
// Where both surfaces are near, the two learners take turns: each would explain the whole of what both see.
#ifndef FLIGHT_GROUND_H
#define FLIGHT_GROUND_H

#include "flight/curve.h"
#include "flight/learn.h"
#include "flight/lpf2.h"
#include <stdbool.h>

typedef struct {
  learn_t learn;
  lpf2_t filter;  // of the height, as all signals of the outer loop have it
  float height_m; // of the feet above where they stand; has a meaning only while known
  bool known;
  bool turn; // the sample is the ground's
} ground_t;

// What one period has for it.
typedef struct {
  float height_m;               // of the feet above where they stand, as it came in
  const learn_sample_t *sample; // of the same tick; null: nothing may be learned
  float excess;                 // what the ceiling gives at that sample: rho_ceiling - 1
  bool shared;                  // the ceiling's curve learns from such a sample, too
} ground_in_t;

// Knows no height yet; the curve that is learned starts at `start`. ST_BAD_PARAM, ST_BAD_INPUT: as rls_init.
MUST_CHECK status_t ground_init(ground_t *g, const learn_param_t *p, const rbf_weights_t *start);

// One period, after the outer loop's. *at becomes what the curve says now: ratio 1, slope 0 where c->mode is
// 0; the slope is over the height. ST_SAMPLE_REFUSED and the like: as learn_update; *at is good nevertheless.
MUST_CHECK status_t ground_step(ground_t *g, const curve_param_t *c, const learn_param_t *p,
                                const lpf2_coef_t *filter, const ground_in_t *in, rbf_point_t *at);

// The height is not controlled, or not flown by: what was learned is kept.
void ground_rest(ground_t *g);

#endif
