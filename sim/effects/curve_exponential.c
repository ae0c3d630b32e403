// curve_exponential.c - 1 + Ca exp(-Cb d/R) (He et al.; thesis eqs 2 and 3.4), finite down to contact.
#include "effects/fx.h"

#include <math.h>

static double ratio(const double *p, const curve_points_t *points, double distance_m, double radius_m) {
  (void)points;
  const double x = p[1] * distance_m / radius_m;
  return x < 40.0 ? 1.0 + p[0] * exp(-x) : 1.0; // beyond, the sum is 1 to the last bit
}

const curve_t curve_exponential = {
    .name = "exponential",
    .brief = "1 + Ca exp(-Cb d/R)",
    .source = "He et al., thesis eqs 2 and 3.4",
    .surfaces = SURFACE_CEILING | SURFACE_GROUND,
    .n_param = 2,
    .param = {{"Ca", "", 0.0, 0.44, 5.0}, {"Cb", "", 0.01, 1.8, 50.0}},
    .ratio = ratio,
};
