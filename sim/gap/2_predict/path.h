// path.h - a replay that is kept (predict.h).
#ifndef SIM_GAP_2_PREDICT_PATH_H
#define SIM_GAP_2_PREDICT_PATH_H

#include "gap/2_predict/grid.h"

// What a replay found at a point.
typedef struct {
  body_look_t look;
  fx_sensed_t sight, sensed; // before and after the model's effects on sensors; sight without a force
  d3_t turn_radps2, air_w_mps;
  int rigid; // index of its rigid_t in the path
} passed_t;

// A replay that is kept: the same model with one effect more then costs only what that effect changes.
typedef struct {
  const model_t *model; // the caller's; must not change
  passed_t *at;
  rigid_t *rigid; // without commands; only those that differ from the one before
  int n_rigid;
  lag_t lag; // of the motors, with this delay
  double delay_s;
  char *kept; // eight points at a time (eight.h), kept_bytes each, in place of `at`; else null
  size_t kept_bytes;
} path_t;

#endif
