// path.h - a replay, kept (predict.h).
#ifndef SIM_GAP_2_PREDICT_PATH_H
#define SIM_GAP_2_PREDICT_PATH_H

#include "gap/2_predict/grid.h"

// What a replay went through at a point.
typedef struct {
  body_look_t look;
  fx_sensed_t sight, sensed; // before and after the model's effects on sensors; sight without a force
  d3_t turn_radps2, air_w_mps;
  int rigid; // which one it was
} passed_t;

// A replay, kept: with it, the same model with one effect more costs what that effect changes.
typedef struct {
  const model_t *model; // the caller's; must not change
  passed_t *at;
  rigid_t *rigid; // without commands; as many as differ from the one before
  int n_rigid;
  lag_t lag; // that the motors had, with this delay
  double delay_s;
  char *kept; // in place of `at`, eight points at a time (eight.h), so many bytes each; else null
  size_t kept_bytes;
} path_t;

#endif
