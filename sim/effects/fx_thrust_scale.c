// fx_thrust_scale.c - every rotor gives more thrust (or less) than the vehicle file has it.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  (void)tick;
  for (int i = 0; i < ROTORS; i++) fx_scale_rotor(plant, i, 1.0 + use->p[0], use->p[1]);
}

const fx_t fx_thrust_scale = {
    .name = "thrust_scale",
    .brief = "every rotor gives more thrust (k > 0) or less than the vehicle file has it",
    .law = "each rotor gives T_i (1 + k)",
    .fly = "throttle steps of 20 %",
    .over = {"thrust"},
    .apart = {{"accel_bias", "throttle steps of 20 %: a bias stays, a scale grows with the thrust"},
              {"thrust_curve", "long climbs and descents with a wide range of throttle"},
              {"inertia", "throttle steps without turning, then attitude doublets"}},
    .group = FX_WEIGHT,
    .scales_thrust = true,
    .n_size = 1,
    .size = {{0, 0.01, 0, 0.0, FX_SAME}},
    .kind_param = 1,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .n_param = 2,
    .param = {{"k", "", -0.9, 0.05, 4.0}, FX_TORQUE},
    .tick = tick,
    .steady = true,
};
