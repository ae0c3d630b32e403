// fx_torque_ratio.c - the rotors' torque over their thrust is larger than the vehicle file has it, or
// smaller.
#include "effects/fx.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  (void)tick;
  for (int i = 0; i < ROTORS; i++) plant->torque_scale[i] *= 1.0 + use->p[0];
}

const fx_t fx_torque_ratio = {
    .name = "torque_ratio",
    .brief = "the rotors' torque over their thrust is larger (k > 0) or smaller than the vehicle file has it",
    .law = "of each rotor the torque over the thrust is (1 + k) times the file's",
    .fly = "yaw doublets",
    .over = {"thrust"},
    .in = "turn_z",
    .apart = {{"inertia", "attitude doublets beside those in yaw: an inertia is seldom wrong about z alone"}},
    .control_makes = -1,
    .scales = FX_SCALES_TORQUE,
    .n_size = 1,
    .size = {{0, 0.01, 0, 0.0, FX_SAME}},
    .n_param = 1,
    .param = {{"k", "", -0.9, 0.1, 4.0}},
    .tick = tick,
    .steady = true,
};
