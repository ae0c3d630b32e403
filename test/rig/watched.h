// watched.h - calls of the checks in front of the control loops, for a vehicle in the air.
#ifndef TEST_RIG_WATCHED_H
#define TEST_RIG_WATCHED_H

#include "flight/bounds.h"
#include "flight/watch.h"
#include "rig/test.h"

#define HOVER_N (0.032f * GRAVITY_MPS2)

// In the air at 1 m, with perfect sensors, no ceiling known.
static inline flight_t hovering(flight_in_t *in) {
  flight_param_t p;
  params_default(&p);
  flight_t f;
  CHECK_OK(flight_init(&f, &p));
  f.outer.param.pos.mass_kg = 0.032f;
  f.outer.carrying_s = 5.0f;
  f.outer.out.ceiling_z_m = NAN;
  *in = (flight_in_t){
      .acc_b_mps2 = {.z = GRAVITY_MPS2},
      .pos_w_m = {.z = 1.0f},
      .q_wb = {.w = 1.0f},
      .setpoint = {.x = AXIS_POSITION, .y = AXIS_POSITION, .z = AXIS_POSITION, .pos_w_m = {.z = 1.0f}}};
  for (int i = 0; i < MOTORS; i++) in->force_N[i] = 0.25f * HOVER_N;
  return f;
}

// Calls the checks `ms` milliseconds after the last call.
static inline flight_in_t watch(flight_t *f, const flight_in_t *in, int ms) {
  flight_in_t flown = *in;
  flown.step = f->step_last + (uint32_t)ms;
  watch_inputs(f, &flown);
  return flown;
}

#endif
