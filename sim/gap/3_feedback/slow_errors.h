// slow_errors.h - errors of the estimates that last for a while: sd and correlation time.
#ifndef SIM_GAP_3_FEEDBACK_SLOW_ERRORS_H
#define SIM_GAP_3_FEEDBACK_SLOW_ERRORS_H

#include "gap/2_predict/grid.h"

typedef struct {
  double sd, tau_s; // 0: none seen
} slow_t;

// Of position (per axis), velocity and attitude, by comparing each with the rate that it should have.
void slow_errors(const grid_t *g, slow_t *pos_m, slow_t *vel_mps, slow_t *angle_rad);

#endif
