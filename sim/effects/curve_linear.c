// curve_linear.c - slope z/R + offset, at least 1 (Wei et al., thesis eq. 3.2): 1 beyond z/R = 4.42.
#include "effects/fx.h"

#include "base/larger.h"
#include <math.h>

static double ratio(const double *p, const curve_points_t *points, double distance_m, double radius_m) {
  (void)points;
  return larger(1.0, p[0] * distance_m / radius_m + p[1]);
}

const curve_t curve_linear = {
    .name = "linear",
    .brief = "slope z/R + offset, at least 1",
    .source = "Wei et al., thesis eq. 3.2",
    .surfaces = SURFACE_GROUND,
    .n_param = 3,
    .param = {{"slope", "", -1.0, -0.0373, 0.0}, {"offset", "", 1.0, 1.1651, 3.0}, CURVE_EACH},
    .ratio = ratio,
};
