// fx_ground.c - ground effect: a rotor over the ground gives more thrust at the same command.
#include "effects/fx.h"

static double excess(const fx_use_t *use, const fx_place_t *place) {
  return use->form->ratio(use->p, &use->points, place->ground_gap_m, place->radius_m) - 1.0;
}

const fx_t fx_ground = {
    .name = "ground",
    .brief = "a rotor over the ground gives more thrust at the same command",
    .law = "each rotor gives T_i times the form's ratio at d",
    .fly = "hover at 1 to 20 cm over the ground",
    .over = {"height"},
    .in = "force_z",
    .apart = {{"battery_sag", "hold 5 cm over the ground on a full and on a nearly empty battery"},
              {"thrust_scale", "hover half a metre up, then 5 cm over the ground: a scale stays"},
              {"mass", "hover half a metre up, then 5 cm over the ground: a mass stays"},
              {"climb_inflow", "hold still at 3, 5 and 9 cm over the ground: inflow needs a climb"},
              {"thrust_curve", "throttle steps half a metre up: a bent curve shows there too"}},
    .needs = FX_NEEDS_POSITION,
    .n_size = 1,
    .size = {{0, 0.01, 1, 0.0, FX_SAME}},
    .shape_param = 1,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .surface = SURFACE_GROUND,
    .form_initial = "exponential",
    .excess = excess,
};
