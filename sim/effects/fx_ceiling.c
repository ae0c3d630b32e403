// fx_ceiling.c - ceiling effect: a rotor under a ceiling gives more thrust at the same command.
#include "effects/fx.h"

static double excess(const fx_use_t *use, const fx_place_t *place) {
  return use->form->ratio(use->p, &use->points, place->ceiling_gap_m, place->radius_m) - 1.0;
}

const fx_t fx_ceiling = {
    .name = "ceiling",
    .brief = "a rotor under a ceiling gives more thrust at the same command",
    .fly = "slow climbs and holds at 2 to 10 cm under the ceiling",
    .n_size = 1,
    .size = {{0, 0.01, 1, 0.0}},
    .shape_param = 1,
    .n_shape = 6,
    .shape = {0.2, 0.34, 0.6, 1.0, 1.8, 3.2},
    .surface = SURFACE_CEILING,
    .form_initial = "exponential",
    .excess = excess,
};
