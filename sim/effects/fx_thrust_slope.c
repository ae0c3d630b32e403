// fx_thrust_slope.c - the curve from command to thrust is steeper than the vehicle file has it, or flatter.
// At a thrust equal to the weight it is the same.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  const double hover_N = plant->mass_kg * G_MPS2 / ROTORS;
  for (int i = 0; i < ROTORS; i++) {
    const double f = tick->thrust_N[i];
    if (!(f > 0.05 * hover_N)) continue; // no thrust, nothing to scale
    const double scale = 1.0 + use->p[0] * (1.0 - hover_N / f);
    fx_scale_rotor(plant, i, scale > 0.0 ? scale : 0.0, use->p[1]);
  }
}

const fx_t fx_thrust_slope = {
    .name = "thrust_slope",
    .brief = "the curve from command to thrust is steeper (k > 0) or flatter, about the weight",
    .law = "each rotor gives T_i + k (T_i - m g/4), not below 0",
    .fly = "throttle steps of 20 %",
    .over = {"thrust"},
    .apart = {{"inertia", "throttle steps without turning, then attitude doublets"},
              {"thrust_scale", "throttle steps of 20 %: at the weight a slope is right"},
              {"thrust_curve", "a wide range of throttle"}},
    .answers = true,
    .about_weight = true,
    .scales_thrust = true,
    .n_size = 1,
    .size = {{0, 0.01, 0, 0.0, FX_SAME}},
    .kind_param = 1,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .n_param = 2,
    .param = {{"k", "", -0.9, 0.1, 4.0}, FX_TORQUE},
    .tick = tick,
};
