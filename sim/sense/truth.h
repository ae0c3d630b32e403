// truth.h - what the sensors measure: where the vehicle is and what is around it, at one instant.
//
// World: z up. Body: x forward, y left, z up. All distances are along the body's z axis, so that a tilt makes
// them longer: a level ceiling at height c above the vehicle is c / cos(tilt) away.
#ifndef SIM_SENSE_TRUTH_H
#define SIM_SENSE_TRUTH_H

#include "base/d3.h"
#include <stdbool.h>

typedef struct {
  d3_t pos_w_m, vel_w_mps;
  dq_t q_wb; // body to world, length 1
  d3_t rate_b_radps;
  d3_t force_b_mps2; // specific force: acceleration minus gravity, (0, 0, 9.81) at rest and level
  double up_m;       // from the upward range sensor to what is above; HUGE_VAL: nothing
  double down_m;     // from the downward range sensor to the ground; HUGE_VAL: none
  bool motors;       // running, so that they shake the inertial sensors
} truth_t;

#endif
