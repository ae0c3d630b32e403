// fx_rotor_tilt.c - the rotors' axes lean about their arms, all the same way round, so that thrust turns the
// vehicle about z. More drag of the rotors of one sense has the same effect.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  double thrust_N = 0.0;
  for (int i = 0; i < ROTORS; i++) thrust_N += plant->thrust_scale[i] * tick->thrust_N[i];
  plant->moment_b_Nm.z += use->p[0] * thrust_N;
}

const fx_t fx_rotor_tilt = {
    .name = "rotor_tilt",
    .brief = "the rotors' axes lean about their arms: thrust turns the vehicle about z",
    .law = "M_z = lever T",
    .fly = "a calm hover",
    .over = {"thrust"},
    .apart = {{"motor_damage", "a calm hover: a weak rotor tilts, too"},
              {"torque_ratio",
               "a calm hover, then yaw doublets: a lean stays, a ratio grows with the command"}},
    .n_size = 1,
    .size = {{0, 1e-5, 0, 0.0, FX_BY_ARM}},
    .n_param = 1,
    .param = {{"lever", "m", -0.05, 3e-4, 0.05}},
    .tick = tick,
};
