// beside.c - what the sideways range sensors see.
#include "drone/beside.h"

#include <math.h>

// Length of a beam from y_m to the wall, slope_y: its change of y per metre. Infinite: it never meets the
// wall.
static double to_wall_m(double y_m, double slope_y, double wall_y_m) {
  const double ahead_m = (wall_y_m - y_m) / slope_y;
  return ahead_m >= 0.0 ? ahead_m : HUGE_VAL; // false for NaN, too
}

void beside_look(d3_t pos_w_m, dq_t q_wb, double wall_y_m, int hand, uint16_t mm[BESIDE_N]) {
  const axes_t axes = axes_of(q_wb);
  const double slope_y[BESIDE_N] = {axes.x.y, -axes.x.y, axes.y.y, -axes.y.y};
  for (int i = 0; i < BESIDE_N; i++) {
    double m = to_wall_m(pos_w_m.y, slope_y[i], wall_y_m);
    if (hand == i + 1) m = fmin(m, BESIDE_HAND_M);
    mm[i] = m <= BESIDE_FAR_M ? (uint16_t)(1e3 * m) : BESIDE_NONE_MM;
  }
}
