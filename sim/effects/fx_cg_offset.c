// fx_cg_offset.c - the centre of mass lies elsewhere. The inertia is kept.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  (void)tick;
  plant->cg_b_m = d3_add(plant->cg_b_m, d3_of(use->p));
}

const fx_t fx_cg_offset = {
    .name = "cg_offset",
    .brief = "the centre of mass lies elsewhere than the vehicle file has it (dx: forwards, dy: to the left)",
    .law = "about the centre of mass at (dx, dy, dz): M = T (-dy, dx, 0)",
    .fly = "a calm hover",
    .over = {"thrust"},
    .apart = {{"inertia", "a calm hover: an offset shows there, inertia in attitude doublets alone"}},
    .n_size = 2,
    .size = {{0, 1e-4, 0, 0.0, FX_BY_ARM}, {1, 1e-4, 0, 0.0, FX_BY_ARM}},
    .n_param = 3,
    .param = {{"dx", "m", -0.5, 1.5e-3, 0.5}, {"dy", "m", -0.5, 0.0, 0.5}, {"dz", "m", -0.5, 0.0, 0.5}},
    .tick = tick,
    .steady = true,
};
