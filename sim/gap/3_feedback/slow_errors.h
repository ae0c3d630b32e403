// slow_errors.h - errors of the estimates that last for a while: sd and correlation time, by axis.
#ifndef SIM_GAP_3_FEEDBACK_SLOW_ERRORS_H
#define SIM_GAP_3_FEEDBACK_SLOW_ERRORS_H

#include "gap/2_predict/grid.h"

// By axis of the world: a height is often known several times better than a horizontal place.
typedef struct {
  double sd[3], tau_s[3]; // 0: none seen
} slow_t;

// Sd of the white noise that every point has of its own, which does not count among the lasting errors.
typedef struct {
  double pos_m[3], vel_mps[3], angle_rad[3];
} white_error_t;

// Finds the lasting errors of position, velocity and attitude (there alike about any axis) by comparing each
// estimate with its logged rate.
void slow_errors(const grid_t *g, const white_error_t *white, slow_t *pos_m, slow_t *vel_mps,
                 slow_t *angle_rad);

#endif
