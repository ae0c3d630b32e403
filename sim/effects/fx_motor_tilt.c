// fx_motor_tilt.c - the axis of one rotor leans, as on a bent mount: its thrust T (at its speed, in free air)
// acts along (x, y, 1), which pushes the hub by T (x, y, 0). Its torque leans with it (1) or stays about z
// (0), as in many simulators. The loss of lift with the square of the angle is left out: 3 % at the end of
// the range. A lean along the arm has the effect of one of the opposite rotor.
#include "effects/fx.h"

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  const rigid_t *const r = motion->rigid;
  for (int i = 0; i < ROTORS; i++) {
    const double om = motion->rotor_radps[i], thrust_N = r->kf_Ns2 * r->thrust_scale[i] * om * om;
    const double its_N = where(fabs(use->p[0] - (i + 1.0)) < 0.5, thrust_N, 0.0);
    const double turns_Nm = -use->p[3] * r->spin[i] * r->torque_ratio_m * r->torque_scale[i] * its_N;
    const fx_hub_t hub = fx_hub(motion, i, 1.0);
    fx_push_hub(&hub, d3(use->p[1] * its_N, use->p[2] * its_N, 0.0), load);
    load->moment_b_Nm = d3_add(load->moment_b_Nm, d3(use->p[1] * turns_Nm, use->p[2] * turns_Nm, 0.0));
  }
}

const fx_t fx_motor_tilt = {
    .name = "motor_tilt",
    .brief = "the axis of one rotor leans (x: forwards, y: to the left); where along its arm, it or the one "
             "opposite",
    .law =
        "of `rotor`, at its hub F = T_i (x, y, 0); torque 1: its torque leans with it, 0: it stays about z",
    .fly = "a calm hover",
    .over = {"thrust"},
    .apart = {{"rotor_tilt", "throttle steps: one rotor that leans pushes to a side, too"},
              {"imu_misalignment", "a calm hover: a rotor that leans across its arm turns the vehicle, too"},
              {"accel_bias", "throttle steps of 20 %: a bias stays, the other grows with the thrust"},
              {"wind", "a full yaw turn on the spot: a rotor turns with the body, wind does not"},
              {"cg_offset", "a calm hover: a rotor that leans pushes to a side, too"},
              {"motor_damage", "throttle steps: a weak rotor lacks lift, one that leans does not"}},
    .needs = FX_NEEDS_TURNING,
    .by_thrust = true,
    .n_size = 2,
    .size = {{1, 1e-3, 0, 0.0, FX_SAME}, {2, 1e-3, 0, 0.0, FX_SAME}},
    .shape_param = 0,
    .n_shape = 4,
    .shape = {1.0, 2.0, 3.0, 4.0},
    .kind_param = 3,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .n_param = 4,
    .param = {{"rotor", "number", 1.0, 1.0, 4.0},
              {"x", "rad", -0.25, 0.03, 0.25},
              {"y", "rad", -0.25, 0.0, 0.25},
              FX_TORQUE},
    .load = load,
};
