// fx_climb_inflow.c - rotors lose thrust in a climb and gain it in a descent. v is taken and the force acts
// at `arm` of the way from the centre of mass to each hub. At the hubs (1) it damps roll and pitch.
#include "effects/fx.h"

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  for (int i = 0; i < ROTORS; i++) {
    const fx_hub_t hub = fx_hub(motion, i, use->p[1]);
    fx_push_hub(&hub, d3(0.0, 0.0, -use->p[0] * motion->rotor_radps[i] * hub.air_b_mps.z), load);
  }
}

const fx_t fx_climb_inflow = {
    .name = "climb_inflow",
    .brief = "rotors lose thrust in a climb and gain it in a descent",
    .law = "at each hub F_z = -k Om_i v_z",
    .fly = "vertical steps",
    .over = {"v_z"},
    .in = "force_z",
    .apart = {{"motor_lag", "a long steady climb: lag ends with the throttle step, inflow stays"},
              {"delay", "a long steady climb: delay ends with the throttle step, inflow stays"},
              {"body_drag", "climbs at 0.5 and 1 m/s: one doubles, the other grows fourfold"}},
    .needs = FX_NEEDS_VELOCITY,
    .n_size = 1,
    .size = {{0, 1e-7, 1, 0.0, FX_BY_MASS_PER_SPEED}},
    .kind_param = 1,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .n_param = 2,
    .param = {{"k", "kg", 0.0, 1.5e-6, 1e-2}, {"arm", "number", 0.0, 1.0, 1.0}},
    .load = load,
};
