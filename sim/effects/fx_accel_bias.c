// fx_accel_bias.c - a constant error of the accelerometer.
#include "effects/fx.h"

static void sense(const fx_use_t *use, fx_sensed_t *sensed) {
  sensed->acc_b_mps2 = d3_add(sensed->acc_b_mps2, d3_of(use->p));
}

const fx_t fx_accel_bias = {
    .name = "accel_bias",
    .brief = "a constant error of the accelerometer",
    .law = "it reads f + (x, y, z), body axes",
    .fly = "a full yaw turn on the spot",
    .over = {"time"},
    .apart = {{"imu_misalignment", "throttle steps of 20 %: a bias stays, the other grows with the thrust"},
              {"wind", "a full yaw turn on the spot: a bias turns with the body, wind does not"}},
    .needs = FX_NEEDS_ACCELERATION,
    .n_size = 3,
    .size = {{0, 0.01, 0, 0.0, FX_SAME}, {1, 0.01, 0, 0.0, FX_SAME}, {2, 0.01, 0, 0.0, FX_SAME}},
    .size_apart = 2, // along z it looks like more mass, along x and y like wind
    .apart_name = "accel_bias z",
    .n_param = 3,
    .param = {{"x", "m/s2", -1.0, 0.12, 1.0}, // beyond 0.1 g a sensor is broken, or it is something else
              {"y", "m/s2", -1.0, 0.0, 1.0},
              {"z", "m/s2", -1.0, 0.0, 1.0}},
    .sense = sense,
};
