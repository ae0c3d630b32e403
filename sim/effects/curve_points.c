// curve_points.c - a measured curve: straight lines between its points, level beyond its ends. Its
// difference from 1 may be scaled.
#include "effects/fx.h"

static double between(const curve_points_t *points, double distance_m, double radius_m) {
  const double x = distance_m / radius_m;
  const int last = points->n - 1;
  if (last < 0) return 1.0;
  if (!(x > points->x[0])) return points->ratio[0];
  for (int i = 1; i <= last; i++) {
    if (x >= points->x[i]) continue;
    const double share = (x - points->x[i - 1]) / (points->x[i] - points->x[i - 1]);
    return points->ratio[i - 1] + share * (points->ratio[i] - points->ratio[i - 1]);
  }
  return points->ratio[last];
}

static double ratio(const double *p, const curve_points_t *points, double distance_m, double radius_m) {
  const double as_measured = between(points, distance_m, radius_m);
  const double scaled = 1.0 + p[0] * (as_measured - 1.0);
  return p[0] == 1.0 ? as_measured : scaled > 0.01 ? scaled : 0.01;
}

static void vary(double *p, curve_points_t *points, double more, double faster) {
  p[0] *= more;
  for (int i = 0; i < points->n; i++) points->x[i] /= faster;
}

const curve_t curve_points = {
    .name = "table",
    .brief = "a measured curve, file=FILE.csv with columns distance_over_radius, ratio",
    .source = "the file",
    .surfaces = SURFACE_CEILING | SURFACE_GROUND,
    .needs_points = 1,
    .n_param = 2,
    .param = {{"scale", "", 0.0, 1.0, 5.0}, CURVE_EACH},
    .ratio = ratio,
    .vary = vary,
};
