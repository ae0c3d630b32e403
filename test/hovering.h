// hovering.h - the guard's inputs in a hover under a ceiling, with sensors that are alive.
#ifndef HOVERING_H
#define HOVERING_H

#include "flight/guard.h"
#include "flight/params.h"

#define HOVERING_CEILING_M 2.0f

// The estimate's gap, the gap wanted, what the range sensor says, and by how much more the thrust carries
// than in free air.
typedef struct {
  float zc_m, wanted_m, range_m, ratio;
} hover_t;

static inline guard_in_t hovering(const hover_t *h, int ms) {
  const float noise = 1e-3f * (float)(ms * 7919 % 13);
  const bool sample = ms % 100 == 0;
  return (guard_in_t){
      .ms = 1,
      .wanted = true,
      .carries = true,
      .rate_b_radps = {noise, -noise, noise},
      .acc_b_mps2 = {noise, noise, 9.81f + noise},
      .pos_w_m = {.z = HOVERING_CEILING_M - h->zc_m},
      .q_wb = {.w = 1.0f},
      .range_new = sample,
      .range_m = sample ? h->range_m + 0.1f * noise : NAN,
      .range_floor_m = 0.045f,
      .range_near_m = 0.05f,
      .thrust_N = 0.33f,
      .thrust_max_N = 0.6f,
      .weight_N = 0.33f,
      .zc_m = h->zc_m,
      .ceiling_z_m = HOVERING_CEILING_M,
      .zc_known = true,
      .setpoint_good = true,
      .setpoint_z_m = HOVERING_CEILING_M - h->wanted_m,
      .asked_z_m = HOVERING_CEILING_M - h->wanted_m,
      .find_bias = true,
      .force_N = 0.33f * h->ratio,
      .thrust_now_N = 0.33f,
  };
}

#endif
