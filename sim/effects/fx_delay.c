// fx_delay.c - a pure delay between command and motors, on top of the vehicle file's, in whole ticks.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  (void)tick;
  plant->delay_s += use->p[0];
}

const fx_t fx_delay = {
    .name = "delay",
    .brief = "commands reach the motors later (add > 0) or earlier than the vehicle file has it",
    .law = "commands act `add` later",
    .fly = "attitude doublets and throttle steps",
    .over = {"thrust"},
    .apart = {{"inertia", "slow and fast attitude doublets: delay hurts the fast ones alone"}},
    .group = FX_TIMING,
    .answers = true,
    .n_size = 1,
    .size = {{0, 4e-3, 1, 5e-3, FX_SAME}},
    .n_param = 1,
    .param = {{"add", "s", 0.0, 0.01, 0.2}},
    .tick = tick,
    .steady = true,
};
