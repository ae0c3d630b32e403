// fx_rotor_drag.c - rotor drag: a force in the rotor plane against the velocity through the air. v is taken
// and the force acts at `arm` of the way from the centre of mass to each hub. At the hubs (1) it damps yaw,
// and pitches the vehicle if they lie above the centre of mass; at the centre of mass (0), as in many
// simulators and in recorded flights of a Crazyflie, it does neither. Source: the form of Faessler, Franchi,
// Scaramuzza 2018 (doi 10.1109/LRA.2017.2776353), at the hubs.
#include "base/few.h"
#include "effects/fx.h"

// Adds the elements one after the other.
FEW_INLINE double plus(double sum, few_t a) {
  for (int i = 0; i < FEW_N; i++) sum += a[i];
  return sum;
}

// The same as fx_hub() and fx_push_hub() for each rotor.
PAIR_COPIES static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  load_t all = *load; // a copy: to a compiler, *load may overlap *motion
  d3_t *const force = &all.force_b_N, *const moment = &all.moment_b_Nm;
  const d3_t air = motion->air_b_mps, rate = motion->rate_b_radps;
  const rigid_t *const r = motion->rigid;
  const double arm = use->p[1];
  for (int i = 0; i < ROTORS; i += FEW_N) {
    const few_t k = use->p[0] * few_of(motion->rotor_radps + i), x = arm * few_of(r->rotor_x_m + i),
                y = arm * few_of(r->rotor_y_m + i), z = arm * few_of(r->rotor_z_m + i);
    const few_t fx = -k * (air.x + (rate.y * z - rate.z * y)), fy = -k * (air.y + (rate.z * x - rate.x * z));
    force->x = plus(force->x, fx);
    force->y = plus(force->y, fy);
    force->z += 0.0; // turns -0 into 0
    moment->x = plus(moment->x, y * 0.0 - z * fy);
    moment->y = plus(moment->y, z * fx - x * 0.0);
    moment->z = plus(moment->z, x * fy - y * fx);
  }
  *load = all;
}

const fx_t fx_rotor_drag = {
    .name = "rotor_drag",
    .brief = "force in the rotor plane against the velocity, linear in it and in the rotor speeds",
    .law = "at each hub F_xy = -k Om_i v_xy",
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
