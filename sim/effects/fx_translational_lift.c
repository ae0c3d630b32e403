// fx_translational_lift.c - more thrust in forward flight. v is taken and the force acts at `arm` of the way
// from the centre of mass to each hub. At the hubs (1) a rotor that advances lifts more than one that
// retreats, and a yawing vehicle is lifted, too.
#include "effects/fx.h"

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  for (int i = 0; i < ROTORS; i++) {
    const fx_hub_t hub = fx_hub(motion, i, use->p[1]);
    const double x = hub.air_b_mps.x, y = hub.air_b_mps.y;
    fx_push_hub(&hub, d3(0.0, 0.0, 0.25 * use->p[0] * (x * x + y * y)), load);
  }
}

const fx_t fx_translational_lift = {
    .name = "translational_lift",
    .brief = "more thrust in forward flight, with the square of the speed",
    .law = "of each rotor F_z = k/4 (v_x^2 + v_y^2)",
    .fly = "circles at two speeds",
    .over = {"v_x", "v_y"},
    .in = "force_z",
    .apart = {{"thrust_curve", "circles at two speeds and one height, then throttle steps on the spot"},
              {"body_drag", "level circles at two speeds: lift is vertical, drag lies in the plane"}},
    .needs = FX_NEEDS_VELOCITY,
    .n_size = 1,
    .size = {{0, 1e-4, 1, 0.0, FX_BY_MASS}},
    .kind_param = 1,
    .n_kind = 2,
    .kind = {0.0, 1.0},
    .n_param = 2,
    .param = {{"k", "kg/m", 0.0, 3e-3, 10.0}, {"arm", "number", 0.0, 0.0, 1.0}},
    .load = load,
};
