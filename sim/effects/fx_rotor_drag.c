// fx_rotor_drag.c - rotor drag: a force in the rotor plane against the velocity through the air,
//   F_xy = -k Om_i v_xy
//
// at `arm` of the way from the centre of mass to each hub, v: of that place. At the hubs (1) it damps yaw,
// and pitches where they lie above the centre of mass; at the centre of mass (0), as simulators often have it
// and as recorded flights of a Crazyflie show it, it does neither. Source: the form of Faessler, Franchi,
// Scaramuzza 2018 (doi 10.1109/LRA.2017.2776353), at the hubs.
#include "effects/fx.h"

PAIR_COPIES static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  load_t all = *load; // what is written through a pointer may be `motion`, to a compiler
  for (int i = 0; i < ROTORS; i++) {
    const double k = use->p[0] * motion->rotor_radps[i];
    const fx_hub_t hub = fx_hub(motion, i, use->p[1]);
    fx_push_hub(&hub, d3(-k * hub.air_b_mps.x, -k * hub.air_b_mps.y, 0.0), &all);
  }
  *load = all;
}

const fx_t fx_rotor_drag = {
    .name = "rotor_drag",
    .brief = "force in the rotor plane against the velocity, linear in it and in the rotor speeds",
    .fly = "sideways faster than 0.5 m/s",
    .over = {"v_x", "v_y"},
    .apart = {{"body_drag", "straight lines at 0.5 and 1.5 m/s: one grows threefold, the other ninefold"},
              {"wind", "the same line there and back: drag turns round, wind does not"},
              {"accel_bias", "a line there and back without a yaw turn: drag turns round, a bias does not"},
              {"imu_misalignment", "level flight at a steady speed, then throttle steps on the spot"}},
    .needs = FX_NEEDS_VELOCITY,
    .n_size = 1,
    .size = {{0, 1e-7, 1, 0.0, FX_BY_MASS_PER_SPEED}},
    .kind_param = 1,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .n_param = 2,
    .param = {{"k", "kg", 0.0, 1e-6, 1e-2}, {"arm", "number", 0.0, 1.0, 1.0}},
    .load = load,
};
