// fx_ceiling_rpm.c - under a ceiling the rotors turn faster at the same command than the gain in thrust says
// (plant/inflow.h), and take less torque and current by the motor's line.
#include "effects/fx.h"
#include <math.h>

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  for (int i = 0; i < ROTORS; i++) {
    const fx_place_t *at = &tick->place[i];
    plant->faster[i] += use->p[0] * exp(-use->p[1] * at->ceiling_gap_m / at->radius_m);
  }
}

const fx_t fx_ceiling_rpm = {
    .name = "ceiling_rpm",
    .brief = "rotors turn faster under a ceiling at the same command, and draw less",
    .law = "each rotor turns faster by k exp(-b d/R) Om_i; its thrust stays",
    .fly = "yaw turns at 2 to 10 cm under the ceiling",
    .over = {"ceiling distance"},
    .in = "turn_z",
    .needs = FX_NEEDS_CEILING | FX_NEEDS_POSITION,
    .n_size = 1,
    .size = {{0, 0.01, 1, 0.0, FX_SAME}},
    .shape_param = 1,
    .n_shape = 3,
    .shape = {0.34, 0.8, 1.8},
    .n_param = 2,
    .param = {{"k", "", 0.0, 0.05, 0.3}, {"b", "", 0.01, 0.8, 50.0}},
    .tick = tick,
};
