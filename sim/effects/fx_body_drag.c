// fx_body_drag.c - drag of the body. The linear terms are for vehicle files of simulators that have linear
// drag, whatever the rotors do; in a search rotor_drag and climb_inflow stand for them, because rotors turn
// nearly alike all the time.
#include "effects/fx.h"

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  const d3_t v = motion->air_b_mps;
  load->force_b_N = d3_add_scaled(load->force_b_N, -use->p[0] * d3_norm(v), v);
  load->force_b_N = d3_sub(load->force_b_N, d3(use->p[1] * v.x, use->p[2] * v.y, use->p[3] * v.z));
}

const fx_t fx_body_drag = {
    .name = "body_drag",
    .brief = "force against the velocity, with its square",
    .law = "F = -c |v| v - (linear_x v_x, linear_y v_y, linear_z v_z)",
    .fly = "straight lines at two speeds, 0.5 m/s and three times that",
    .over = {"v_x", "v_y"},
    .apart = {{"wind", "the same line there and back: drag turns round, wind does not"},
              {"accel_bias", "a line there and back without a yaw turn: drag turns round, a bias does not"}},
    .needs = FX_NEEDS_VELOCITY,
    .n_size = 1,
    .size = {{0, 1e-4, 1, 0.0, FX_BY_MASS}},
    .n_param = 4,
    .param = {{"c", "kg/m", 0.0, 2e-3, 10.0},
              {"linear_x", "kg/s", 0.0, 0.0, 100.0},
              {"linear_y", "kg/s", 0.0, 0.0, 100.0},
              {"linear_z", "kg/s", 0.0, 0.0, 100.0}},
    .load = load,
};
