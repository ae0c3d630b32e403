// curve_exponential.c - 1 + Ca exp(-Cb d/R) (He et al.; thesis eqs 2 and 3.4), finite down to contact.
#include "effects/fx.h"

#include "plant/decay.h"

static double ratio(const double *p, const curve_points_t *points, double distance_m, double radius_m) {
  (void)points;
  return 1.0 + decay(p[0], p[1] / radius_m, few_all(distance_m))[0];
}

PAIR_COPIES static void add_excess(const double *p, const double distance_m[ROTORS], double radius_m,
                                   double ratio[ROTORS]) {
  const double k = p[1] / radius_m;
  for (int i = 0; i < ROTORS; i += FEW_N)
    few_put(ratio + i, few_of(ratio + i) + decay(p[0], k, few_of(distance_m + i)));
}

static void vary(double *p, curve_points_t *points, double more, double faster) {
  (void)points;
  p[0] *= more;
  p[1] *= faster;
}

const curve_t curve_exponential = {
    .name = "exponential",
    .brief = "1 + Ca exp(-Cb d/R)",
    .source = "He et al., thesis eqs 2 and 3.4",
    .surfaces = SURFACE_CEILING | SURFACE_GROUND,
    .n_param = 3,
    .param = {{"Ca", "", 0.0, 0.44, 5.0}, {"Cb", "", 0.01, 1.8, 50.0}, CURVE_EACH},
    .n_shape = 6,
    .shape = {0.2, 0.34, 0.6, 1.0, 1.8, 3.2},
    .ratio = ratio,
    .vary = vary,
    .add_excess = add_excess,
};
