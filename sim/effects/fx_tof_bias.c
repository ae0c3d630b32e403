// fx_tof_bias.c - the range sensors read too much (or too little) by a constant.
#include "effects/fx.h"

static void sense(const fx_use_t *use, fx_sensed_t *sensed) {
  sensed->range_m += use->p[0];
}

const fx_t fx_tof_bias = {
    .name = "tof_bias",
    .brief = "the range sensors read too much (add > 0) or too little by a constant",
    .law = "they read d + add",
    .fly = "vertical sweeps",
    .over = {"height"},
    .apart = {{"tof_latency", "the same vertical sweep up and down: latency changes its sign"},
              {"tof_floor", "a vertical sweep from far to contact: a bias is there far away too"}},
    .needs = FX_NEEDS_RANGE,
    .in_height = true,
    .n_size = 1,
    .size = {{0, 1e-3, 0, 0.0, FX_SAME}},
    .n_param = 1,
    .param = {{"add", "m", -0.5, 0.02, 0.5}},
    .sense = sense,
};
