// fx_tof_latency.c - the range sensors are late: what they read was true some time ago.
#include "effects/fx.h"

static void sense(const fx_use_t *use, fx_sensed_t *sensed) {
  sensed->range_m -= use->p[0] * sensed->range_rate_mps;
}

const fx_t fx_tof_latency = {
    .name = "tof_latency",
    .brief = "what the range sensors read was true some time ago",
    .law = "they read d - add d', d' the rate of d",
    .fly = "vertical sweeps",
    .over = {"v_z"},
    .needs = FX_NEEDS_RANGE,
    .n_size = 1,
    .size = {{0, 5e-3, 1, 5e-3, FX_SAME}},
    .n_param = 1,
    .param = {{"add", "s", 0.0, 0.05, 1.0}},
    .sense = sense,
};
