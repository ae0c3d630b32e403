// fx_flapping.c - the discs tilt back in forward flight.
#include "effects/fx.h"

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  for (int i = 0; i < ROTORS; i++) {
    const double k = use->p[0] * motion->rotor_radps[i];
    const d3_t v = fx_hub(motion, i, 1.0).air_b_mps;
    load->moment_b_Nm.x += k * v.y;
    load->moment_b_Nm.y -= k * v.x;
  }
}

const fx_t fx_flapping = {
    .name = "flapping",
    .brief = "the rotor discs tilt back in forward flight",
    .law = "of each rotor M = k Om_i (v_y, -v_x, 0), v: of its hub",
    .fly = "sideways steps",
    .over = {"v_x", "v_y"},
    .apart = {{"cg_offset", "sideways steps both ways: flapping turns round, an offset stays"},
              {"motor_damage", "sideways steps both ways: flapping turns round, a weak rotor stays weak"}},
    .needs = FX_NEEDS_VELOCITY,
    .n_size = 1,
    .size = {{0, 1e-9, 0, 0.0, FX_BY_INERTIA_PER_SPEED}},
    .n_param = 1,
    .param = {{"k", "kg m", -1e-3, 1.2e-8, 1e-3}},
    .load = load,
};
