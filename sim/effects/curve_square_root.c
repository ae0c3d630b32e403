// curve_square_root.c - 0.5 + 0.5 sqrt(1 + (R/d)^2/k) (Hsiao and Chirarattananon), from d = dmin R on: nearer
// it is held, because it has not been measured there and would be infinite at contact.
#include "effects/fx.h"

#include "base/larger.h"
#include <math.h>

static double ratio(const double *p, const curve_points_t *points, double distance_m, double radius_m) {
  (void)points;
  const double r = radius_m / larger(distance_m, p[1] * radius_m);
  return 0.5 + 0.5 * sqrt(1.0 + r * r / p[0]);
}

// faster: at d it becomes what it was at d times `faster`. more: exact for a small excess, (R/d)^2 / 4k.
static void vary(double *p, curve_points_t *points, double more, double faster) {
  (void)points;
  p[0] *= faster * faster / more;
  p[1] /= faster;
}

const curve_t curve_square_root = {
    .name = "square-root",
    .brief = "0.5 + 0.5 sqrt(1 + (R/d)^2/k), d >= dmin R",
    .source = "Hsiao and Chirarattananon 2019, arXiv 1905.04632",
    .surfaces = SURFACE_CEILING,
    .n_param = 3,
    .param = {{"k", "", 0.5, 8.0, 100.0}, {"dmin", "R", 0.01, 0.1, 1.0}, CURVE_EACH},
    .ratio = ratio,
    .vary = vary,
};
