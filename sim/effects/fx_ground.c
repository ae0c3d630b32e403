// fx_ground.c - ground effect: a rotor over the ground gives more thrust at the same command.
#include "effects/fx.h"

static double excess(const fx_use_t *use, const fx_place_t *place) {
  return use->form->ratio(use->p, &use->points, place->ground_gap_m, place->radius_m) - 1.0;
}

const fx_t fx_ground = {
    .name = "ground",
    .brief = "a rotor over the ground gives more thrust at the same command",
    .surface = SURFACE_GROUND,
    .form_initial = "exponential",
    .excess = excess,
};
