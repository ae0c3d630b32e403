// hovering.h - the guard's inputs in a hover under a ceiling, with working sensors.
#ifndef TEST_RIG_HOVERING_H
#define TEST_RIG_HOVERING_H

#include "flight/guard.h"
#include "flight/params.h"

#define HOVERING_CEILING_M 2.0f

// Distance to the ceiling as estimated and as wanted, the range sensor's reading, and thrust over that in
// free air for the same command.
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
      .force_new = true,
  };
}

static const hover_t HOVERING_FREE = {0.30f, 0.30f, 0.30f, 1.0f}, HOVERING_NEAR = {0.10f, 0.10f, 0.10f, 1.0f};

// Puts a fault into the inputs; ms: time since it began.
typedef void hovering_edit_fn(guard_in_t *in, float value, int ms);

typedef struct {
  guard_t g;
  int ms, since_ms; // time of flight, time since the fault began
} watched_t;

static inline guard_param_t hovering_param(void) {
  flight_param_t p;
  params_default(&p);
  return p.guard;
}

static inline void hovering_fly(watched_t *w, const hover_t *h, hovering_edit_fn *edit, float value,
                                int span_ms) {
  const guard_param_t p = hovering_param();
  for (int k = 0; k < span_ms; k++) {
    guard_in_t in = hovering(h, w->ms++);
    if (edit) edit(&in, value, ++w->since_ms);
    guard_step(&w->g, &p, &in);
  }
}

// Returns the guard after three seconds without a fault.
static inline watched_t hovering_started(const hover_t *h) {
  watched_t w = {.ms = 1};
  guard_init(&w.g);
  hovering_fly(&w, h, NULL, 0.0f, 3000);
  return w;
}

#endif
