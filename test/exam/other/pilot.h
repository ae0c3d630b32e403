// pilot.h - the second plant's own controller: a PID cascade of position, speed, attitude and rates, with
// limits.
#ifndef TEST_EXAM_OTHER_PILOT_H
#define TEST_EXAM_OTHER_PILOT_H

#include "exam/other/nature.h"

#define PILOT_S 0.002 // between two calls

typedef struct {
  vec_t pos_m, vel_mps;
  double yaw_rad;
} pilot_wish_t;

// The state as the pilot's estimator has it.
typedef struct {
  vec_t pos_m, vel_mps, rate_radps;
  turn_t q;
} pilot_view_t;

// Gains follow from the known lag and delay.
typedef struct {
  nature_t known;
  double rate_gain, rate_lead, att_gain, vel_gain, pos_gain, up_gain;
  vec_t vel_sum, rate_sum, rate_before, acc_mps2;
  int calls;
} pilot_state_t;

void pilot_start(pilot_state_t *p, const nature_t *known, double briskness);
void pilot_fly(pilot_state_t *p, const pilot_view_t *view, const pilot_wish_t *wish, double command_radps[4]);

#endif
