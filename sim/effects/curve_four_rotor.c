// curve_four_rotor.c - four coplanar rotors over the ground by the method of images (Sanchez-Cuevas et al.,
// thesis eq. 3.3):
//
//   1/(1 - (R/4z)^2 - R^2 z/(d^2+4z^2)^1.5 - (R^2/2) z/(2d^2+4z^2)^1.5 - 2 R^2 Kb z/(b^2+4z^2)^1.5)
//
// d: distance of neighbouring rotors, b: of opposite ones, Kb: lift of the body. Singular near z = R/4: held
// at `max`.
#include "effects/fx.h"

#include <math.h>

static double image(double z_m, double apart2_m2) {
  return where(isfinite(z_m), z_m / pow(apart2_m2 + 4.0 * z_m * z_m, 1.5), 0.0);
}

static double ratio(const double *p, const curve_points_t *points, double distance_m, double radius_m) {
  (void)points;
  const double z = distance_m, R2 = radius_m * radius_m, d2 = p[0] * p[0], b2 = p[1] * p[1];
  const double k = radius_m / (4.0 * z);
  const double denominator =
      1.0 - k * k - R2 * image(z, d2) - 0.5 * R2 * image(z, 2.0 * d2) - 2.0 * R2 * p[2] * image(z, b2);
  return where(denominator > 1.0 / p[3], 1.0 / denominator, p[3]);
}

const curve_t curve_four_rotor = {
    .name = "four-rotor",
    .brief = "four coplanar rotors by the method of images, at most max",
    .source = "Sanchez-Cuevas et al., thesis eq. 3.3; d and b of the Crazyflie 2.1, Kb of its authors",
    .surfaces = SURFACE_GROUND,
    .n_param = 5,
    .param = {{"d", "m", 0.01, 0.065, 2.0},
              {"b", "m", 0.01, 0.092, 3.0},
              {"Kb", "", 0.0, 2.0, 10.0},
              {"max", "", 1.0, 1.6, 5.0},
              CURVE_EACH},
    .ratio = ratio,
};
