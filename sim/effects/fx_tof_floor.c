// fx_tof_floor.c - a range sensor reads its floor where the distance is shorter. share: 1, or less if only
// some samples do.
#include "effects/fx.h"

static void sense(const fx_use_t *use, fx_sensed_t *sensed) {
  const double below_m = use->p[0] - sensed->range_m;
  sensed->range_m = where(below_m > 0.0, sensed->range_m + use->p[1] * below_m, sensed->range_m);
}

const fx_t fx_tof_floor = {
    .name = "tof_floor",
    .brief = "nearer than its floor a range sensor says its floor",
    .law = "they read d + share (floor - d) where d < floor",
    .fly = "vertical sweeps down to contact",
    .over = {"ceiling distance", "height"},
    .apart = {{"tof_latency", "stand still near the surface: latency needs a climb"}},
    .needs = FX_NEEDS_RANGE,
    .n_size = 1,
    .size = {{1, 0.1, 1, 0.0, FX_SAME}},
    .shape_param = 0,
    .n_shape = 4,
    .shape = {0.08, 0.1, 0.12, 0.15},
    .n_param = 2,
    .param = {{"floor", "m", 0.0, 0.08, 1.0}, {"share", "", 0.0, 1.0, 1.0}},
    .sense = sense,
};
