// fx_gyroscopic.c - the rotors' angular momentum is larger (or smaller) than the vehicle file has it.
#include "effects/fx.h"

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  double spin_radps = 0.0;
  for (int i = 0; i < ROTORS; i++) spin_radps += motion->rigid->spin[i] * motion->rotor_radps[i];
  const double h = use->p[0] * spin_radps;
  load->moment_b_Nm.x -= h * motion->rate_b_radps.y;
  load->moment_b_Nm.y += h * motion->rate_b_radps.x;
}

const fx_t fx_gyroscopic = {
    .name = "gyroscopic",
    .brief = "the rotors' angular momentum is larger (k > 0) or smaller than the vehicle file has it",
    .law = "M = -w x e_z k sum(s_i Om_i)",
    .fly = "fast roll with yaw",
    .over = {"roll rate"},
    .n_size = 1,
    .size = {{0, 1e-9, 0, 0.0, FX_BY_INERTIA_PER_SPEED}},
    .n_param = 1,
    .param = {{"k", "kg m2", -1e-3, 3e-8, 1e-3}},
    .load = load,
};
