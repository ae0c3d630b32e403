// fx_translational_lift.c - more thrust in forward flight: F_z = k (v_x^2 + v_y^2).
#include "effects/fx.h"

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  const double x = motion->air_b_mps.x, y = motion->air_b_mps.y;
  load->force_b_N.z += use->p[0] * (x * x + y * y);
}

const fx_t fx_translational_lift = {
    .name = "translational_lift",
    .brief = "more thrust in forward flight, with the square of the speed",
    .fly = "circles at two speeds",
    .over = {"v_x", "v_y"},
    .in = "force_z",
    .apart = {{"thrust_curve", "circles at two speeds and one height, then throttle steps on the spot"},
              {"body_drag", "level circles at two speeds: lift is vertical, drag lies in the plane"}},
    .needs = FX_NEEDS_VELOCITY,
    .n_size = 1,
    .size = {{0, 1e-4, 1, 0.0, FX_BY_MASS}},
    .n_param = 1,
    .param = {{"k", "kg/m", 0.0, 3e-3, 10.0}},
    .load = load,
};
