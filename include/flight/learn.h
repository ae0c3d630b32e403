// learn.h - which samples the thrust-ratio curve may learn from; feeds rls.
//
//   y = (m x specific force along the thrust) / (thrust that the motors give in free air)    (thesis 5.2)
//
// Numerator, denominator and distance have passed the same filter. y is 1 in free air, whatever the vehicle
// does. Between two surfaces the excess of the other surface is subtracted (ground.h).
#ifndef FLIGHT_LEARN_H
#define FLIGHT_LEARN_H

#include "flight/rls.h"
#include "flight/sync.h"
#include <stdbool.h>

typedef struct {
  rls_param_t rls;
  float near_m;      // >= 0    nearer than this is contact, not flight
  float far_m;       // > near_m  farther than this is not learned from
  float blind_max_s; // >= 0    longest time without a range sample for which the distance is believed
  float up_min;      // 0..1    smallest vertical share of the thrust's direction (cosine of the tilt)
  float thrust_min;  // 0..1    smallest thrust, as a share of the weight m g
  float settle_s;    // >= 0    time after a saturated command until the thrust is known again
  float y_max;       // > 1     ratios beyond y_max or below 1/y_max are bumps
} learn_param_t;

typedef struct {
  float zc_m;          // distance propeller plane to surface
  bool known;          // zc_m is valid
  float blind_s;       // time since a sensor last corrected zc_m
  float up;            // vertical share of the thrust's direction
  float force_N;       // mass times specific force along the thrust, filtered
  float thrust_N;      // thrust of the motors in free air, filtered likewise
  float weight_N;      // m g
  float since_limit_s; // time since the command was at a limit
} learn_sample_t;

typedef struct {
  rls_t rls;
  float y;          // the last ratio that was learned from, for logs; 0: none yet
  unsigned refused; // samples that were not learned from
} learn_t;

// Returns the sample that the synchronous signals give for a vehicle of mass_kg. The caller fills in the
// distance (zc_m, known, blind_s).
learn_sample_t learn_sample(const sync_t *s, const sync_out_t *x, float mass_kg);

// Starts the learner at the weights `start`. ST_BAD_PARAM, ST_BAD_INPUT: as rls_init.
MUST_CHECK status_t learn_init(learn_t *s, const learn_param_t *p, const rbf_weights_t *start);

// Learns from a sample. ST_OK: done. ST_SAMPLE_REFUSED: the sample is outside a limit of learn_param_t, or
// not finite; weights and covariance are the same to the bit. ST_BAD_PARAM, ST_BAD_INPUT, ST_SINGULAR: as
// rls_update.
// excess: the part of the ratio that another surface gives there; 0: there is none.
MUST_CHECK status_t learn_update(learn_t *s, const learn_param_t *p, const learn_sample_t *sample,
                                 float excess);

#endif
