// fx_ceiling.c - ceiling effect: a rotor under a ceiling gives more thrust at the same command.
#include "effects/fx.h"

static double excess(const fx_use_t *use, const fx_place_t *place) {
  return use->form->ratio(use->p, &use->points, place->ceiling_gap_m, place->radius_m) - 1.0;
}

const fx_t fx_ceiling = {
    .name = "ceiling",
    .brief = "a rotor under a ceiling gives more thrust at the same command",
    .law = "each rotor gives T_i times the form's ratio at d",
    .fly = "slow climbs and holds at 2 to 10 cm under the ceiling",
    .over = {"ceiling distance"},
    .in = "force_z",
    .apart = {{"battery_sag", "hold 5 cm under the ceiling on a full and on a nearly empty battery"},
              {"ground", "the same heights over the floor, once under the ceiling and once away from it"},
              {"thrust_scale", "hover half a metre below the ceiling, then 5 cm below it: a scale stays"},
              {"mass", "hover half a metre below the ceiling, then 5 cm below it: a mass stays"},
              {"climb_inflow", "hold still at 3, 5 and 9 cm under the ceiling: inflow needs a climb"},
              {"thrust_curve", "throttle steps far from the ceiling: a bent curve shows there too"},
              {"tof_bias", "stand still at measured distances: the bias is in the range alone"},
              {"ceiling_rpm", "log the rotor speeds while you hold 5 cm under the ceiling"}},
    .needs = FX_NEEDS_CEILING | FX_NEEDS_POSITION,
    .n_size = 1,
    .size = {{0, 0.01, 1, 0.0, FX_SAME}},
    .shape_param = 1,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .surface = SURFACE_CEILING,
    .form_initial = "exponential",
    .excess = excess,
};
