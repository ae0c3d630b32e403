// fx_sidewall.c - a wall beside the vehicle pulls it and turns its top towards itself; both decay with the
// distance d of the centre of mass from the wall, a plane of constant y. Form and nominal numbers are
// assumptions: nothing is published.
#include "effects/fx.h"
#include <math.h>

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  const double to_wall_m = use->p[0] - motion->pos_w_m.y;
  const double share = exp(-fabs(to_wall_m) / use->p[3]);
  const double side = to_wall_m < 0.0 ? -share : share;
  // The top goes to +y in a turn about -x.
  load_add(load, axes_to_body(motion->axes, d3(0.0, side * use->p[1], 0.0)),
           axes_to_body(motion->axes, d3(-side * use->p[2], 0.0, 0.0)));
}

const fx_t fx_sidewall = {
    .name = "sidewall",
    .brief = "a wall pulls the vehicle and turns its top towards itself",
    .law =
        "F = force exp(-d/length) towards the wall, M = moment exp(-d/length), top towards it, d: from the "
        "centre of mass",
    .fly = "slow approaches to the wall, sideways",
    .over = {"y"},
    .apart = {{"wind", "the same height beside the wall and away from it: wind is there too"},
              {"accel_bias", "beside the wall and away from it: a bias stays"}},
    .needs = FX_NEEDS_WALL | FX_NEEDS_POSITION | FX_NEEDS_VELOCITY,
    .n_size = 2,
    .size = {{1, 1e-4, 0, 0.0, FX_BY_MASS}, {2, 1e-6, 0, 0.0, FX_BY_INERTIA}},
    .shape_param = 3,
    .n_shape = 5,
    .shape = {0.02, 0.04, 0.07, 0.12, 0.2},
    .n_param = 4,
    .param = {{"y", "m", -100.0, 1.0, 100.0},
              {"force", "N", -50.0, 5e-3, 50.0},
              {"moment", "N m", -10.0, 2e-5, 10.0},
              {"length", "m", 1e-3, 0.05, 10.0}},
    .load = load,
};
