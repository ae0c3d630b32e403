// fx_motor_lag.c - the motors' first-order lag is longer (or shorter) than the vehicle file has it.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  (void)tick;
  const double tau_s = plant->motor_tau_s + use->p[0];
  plant->motor_tau_s = tau_s > 0.0 ? tau_s : 0.0;
}

const fx_t fx_motor_lag = {
    .name = "motor_lag",
    .brief = "the motors are slower (add > 0) or faster than the vehicle file has them",
    .law = "the time constant of the motors is tau + add, not below 0",
    .fly = "attitude doublets and throttle steps",
    .over = {"thrust"},
    .apart = {{"delay", "sharp throttle and attitude doublets, logged at 500 Hz"},
              {"inertia", "slow and fast attitude doublets: lag hurts the fast ones alone"}},
    .group = FX_TIMING,
    .lags = true,
    .answers = true,
    .n_size = 1,
    .size = {{0, 0.03, 0, 5e-3, FX_SAME}},
    .n_param = 1,
    .param = {{"add", "s", -0.5, 0.025, 2.0}},
    .tick = tick,
    .steady = true,
};
