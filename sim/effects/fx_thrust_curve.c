// fx_thrust_curve.c - a bend in the curve from command to thrust.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  const double hover_N = plant->mass_kg * G_MPS2 / ROTORS;
  for (int i = 0; i < ROTORS; i++) {
    const double f = tick->thrust_N[i], off = f - hover_N;
    if (!(f > 0.05 * hover_N)) continue; // no thrust, nothing to scale
    const double scale = 1.0 + use->p[0] * off * off / f;
    fx_scale_rotor(plant, i, scale > 0.0 ? scale : 0.0, use->p[1]);
  }
}

const fx_t fx_thrust_curve = {
    .name = "thrust_curve",
    .brief = "a bend in the curve from command to thrust",
    .law = "each rotor gives T_i + k (T_i - m g/4)^2, not below 0",
    .fly = "a wide range of throttle",
    .over = {"thrust"},
    .about_weight = true,
    .scales_thrust = true,
    .n_size = 1,
    .size = {{0, 0.05, 0, 0.0, FX_BY_PER_WEIGHT}},
    .kind_param = 1,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .n_param = 2,
    .param = {{"k", "1/N", -100.0, 1.5, 100.0}, FX_TORQUE},
    .tick = tick,
};
