// fx_climb_inflow.c - rotors lose thrust in a climb and gain it in a descent: F_z = -k sum(Om) v_z.
#include "effects/fx.h"

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  load->force_b_N.z -= use->p[0] * motion->rotor_sum_radps * motion->air_b_mps.z;
}

const fx_t fx_climb_inflow = {
    .name = "climb_inflow",
    .brief = "rotors lose thrust in a climb and gain it in a descent",
    .fly = "vertical steps",
    .over = {"v_z"},
    .in = "force_z",
    .apart = {{"motor_lag", "a long steady climb: lag ends with the throttle step, inflow stays"},
              {"delay", "a long steady climb: delay ends with the throttle step, inflow stays"},
              {"body_drag", "climbs at 0.5 and 1 m/s: one doubles, the other grows fourfold"}},
    .needs = FX_NEEDS_VELOCITY,
    .n_size = 1,
    .size = {{0, 1e-7, 1, 0.0}},
    .n_param = 1,
    .param = {{"k", "kg", 0.0, 1.5e-6, 1e-2}},
    .load = load,
};
