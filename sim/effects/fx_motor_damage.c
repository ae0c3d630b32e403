// fx_motor_damage.c - one rotor gives less thrust, from a time on.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  if (tick->t_s < use->p[2]) return;
  fx_scale_rotor(plant, (int)(use->p[0] + 0.5) - 1, 1.0 - use->p[1], use->p[3]);
}

const fx_t fx_motor_damage = {
    .name = "motor_damage",
    .brief = "one rotor gives less thrust",
    .law = "number `rotor` gives T_i (1 - loss), from `start` on",
    .fly = "a calm hover",
    .over = {"thrust"},
    .apart = {{"inertia", "a calm hover: damage shows there, inertia in attitude doublets alone"},
              {"cg_offset",
               "throttle steps: a weak rotor lacks lift, the more the thrust, an offset does not"}},
    .n_size = 1,
    .size = {{1, 1e-3, 1, 0.0, FX_SAME}},
    .shape_param = 0,
    .n_shape = 4,
    .shape = {1.0, 2.0, 3.0, 4.0},
    .kind_param = 3,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .n_param = 4,
    .param = {{"rotor", "number", 1.0, 1.0, 4.0},
              {"loss", "", 0.0, 0.06, 1.0},
              {"start", "s", 0.0, 0.0, 1e6},
              FX_TORQUE},
    .tick = tick,
};
