// fx_ceiling.c - ceiling effect: a rotor under a ceiling gives more thrust at the same command.
#include "effects/fx.h"

static double excess(const fx_use_t *use, const fx_place_t *place) {
  return use->form->ratio(use->p, &use->points, place->ceiling_gap_m, place->radius_m) - 1.0;
}

const fx_t fx_ceiling = {
    .name = "ceiling",
    .brief = "a rotor under a ceiling gives more thrust at the same command",
    .surface = SURFACE_CEILING,
    .form_initial = "exponential",
    .excess = excess,
};
