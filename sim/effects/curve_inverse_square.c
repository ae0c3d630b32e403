// curve_inverse_square.c - 1 + k (R/4)^2 / (d^2 + (d0 R)^2). Far off it is 1 + k (R/4d)^2 (ground effect of
// Panerati et al. 2021, arXiv 2103.02142; with k = 1 the first term of Cheeseman and Bennett's). d0 keeps it
// finite down to contact, where it has not been measured.
#include "effects/fx.h"

static double ratio(const double *p, const curve_points_t *points, double distance_m, double radius_m) {
  (void)points;
  const double d = distance_m / radius_m;
  return 1.0 + p[0] / (16.0 * (d * d + p[1] * p[1]));
}

static void vary(double *p, curve_points_t *points, double more, double faster) {
  (void)points;
  p[0] *= more / (faster * faster);
  p[1] /= faster;
}

const curve_t curve_inverse_square = {
    .name = "inverse-square",
    .brief = "1 + k (R/4)^2/(d^2 + (d0 R)^2)",
    .source = "Panerati et al. 2021, arXiv 2103.02142; d0 keeps it finite",
    .surfaces = SURFACE_CEILING | SURFACE_GROUND,
    .n_param = 3,
    .param = {{"k", "", 0.0, 1.0, 100.0}, {"d0", "R", 0.05, 0.5, 10.0}, CURVE_EACH},
    .n_shape = 3,
    .shape = {0.25, 0.75, 2.25},
    .ratio = ratio,
    .vary = vary,
};
