// fx_rotor_drag.c - rotor drag: a force in the rotor plane against the velocity through the air,
//   F_xy = -k sum(Om) v_xy
#include "effects/fx.h"

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  const double k = use->p[0] * motion->rotor_sum_radps;
  load->force_b_N.x -= k * motion->air_b_mps.x;
  load->force_b_N.y -= k * motion->air_b_mps.y;
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
    .size = {{0, 1e-7, 1, 0.0}},
    .n_param = 1,
    .param = {{"k", "kg", 0.0, 1e-6, 1e-2}},
    .load = load,
};
