// fx_mass.c - more mass (or less) than the vehicle file has, at the centre of mass: always, or a load taken
// on at one time and dropped at another. It is at rest relative to the vehicle when it comes and goes. The
// inertia is kept.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  if (tick->t_s < use->p[1] || tick->t_s >= use->p[2]) return;
  const double mass_kg = plant->mass_kg + use->p[0];
  plant->mass_kg = mass_kg > 1e-4 ? mass_kg : 1e-4;
}

const fx_t fx_mass = {
    .name = "mass",
    .brief = "the vehicle is heavier (add > 0) or lighter, or carries something for a time",
    .law = "the mass is m + add, from `start` to `end`",
    .fly = "throttle steps of 20 %",
    .over = {"time"},
    .apart = {{"thrust_scale",
               "attitude doublets, logged at 500 Hz: a thrust scale changes moments too, a mass does not"},
              {"accel_bias", "throttle steps of 20 %: a bias stays, what a mass does grows with the thrust"}},
    .group = FX_WEIGHT,
    .n_size = 1,
    .size = {{0, 1e-4, 0, 0.0, FX_BY_MASS}},
    .n_param = 3,
    .param = {{"add", "kg", -50.0, 1.6e-3, 50.0}, {"start", "s", 0.0, 0.0, 1e6}, {"end", "s", 0.0, 1e6, 1e6}},
    .tick = tick,
};
