// fx_inertia.c - the inertia about each axis is larger (or smaller) than the vehicle file has it.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  (void)tick;
  plant->inertia_scale.x *= 1.0 + use->p[0];
  plant->inertia_scale.y *= 1.0 + use->p[1];
  plant->inertia_scale.z *= 1.0 + use->p[2];
}

const fx_t fx_inertia = {
    .name = "inertia",
    .brief = "the inertia about each axis is larger (> 0) or smaller than the vehicle file has it",
    .law = "about each axis J (1 + kx), J (1 + ky), J (1 + kz)",
    .fly = "attitude doublets",
    .over = {"roll rate", "yaw rate"},
    .control_makes = 1,
    .answers = true,
    .scales = FX_SCALES_INERTIA,
    .n_size = 3,
    .size = {{0, 0.01, 0, 0.0, FX_SAME}, {1, 0.01, 0, 0.0, FX_SAME}, {2, 0.01, 0, 0.0, FX_SAME}},
    .n_param = 3,
    .param = {{"kx", "", -0.7, 0.1, 3.0}, {"ky", "", -0.7, 0.1, 3.0}, {"kz", "", -0.7, 0.1, 3.0}},
    .tick = tick,
    .steady = true,
};
