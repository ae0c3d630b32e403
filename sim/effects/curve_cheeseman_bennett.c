// curve_cheeseman_bennett.c - 1/(1 - (R/4d)^2) (thesis eqs 1 and 3.1). Singular at d = R/4: held at `max`, as
// the thesis does (section 4.2.2), from there to contact.
#include "effects/fx.h"

static double ratio(const double *p, const curve_points_t *points, double distance_m, double radius_m) {
  (void)points;
  const double k = radius_m / (4.0 * distance_m);
  const double denominator = 1.0 - k * k;
  return where(denominator > 1.0 / p[0], 1.0 / denominator, p[0]); // k is infinite at contact
}

const curve_t curve_cheeseman_bennett = {
    .name = "cheeseman-bennett",
    .brief = "1/(1 - (R/4d)^2), at most max",
    .source = "Cheeseman and Bennett 1955, thesis eqs 1 and 3.1",
    .surfaces = SURFACE_CEILING | SURFACE_GROUND,
    .n_param = 2,
    .param = {{"max", "", 1.0, 1.6, 5.0}, CURVE_EACH},
    .ratio = ratio,
};
