// fx_imu_misalignment.c - the accelerometer is turned by a small angle from the body.
#include "effects/fx.h"

static void sense(const fx_use_t *use, fx_sensed_t *sensed) {
  const d3_t theta = {use->p[0], use->p[1], 0.0};
  sensed->acc_b_mps2 = d3_add(sensed->acc_b_mps2, d3_cross(sensed->acc_b_mps2, theta));
}

const fx_t fx_imu_misalignment = {
    .name = "imu_misalignment",
    .brief = "the accelerometer is turned by a small angle from the body",
    .law = "it reads f + f x (x, y, 0)",
    .fly = "throttle steps of 20 %",
    .over = {"thrust"},
    .apart = {{"wind", "a full yaw turn on the spot: the sensor turns with the body, wind does not"}},
    .needs = FX_NEEDS_ACCELERATION,
    .n_size = 2,
    .size = {{0, 1e-3, 0, 0.0, FX_SAME}, {1, 1e-3, 0, 0.0, FX_SAME}},
    .n_param = 2,
    .param = {{"x", "rad", -0.5, 0.02, 0.5}, {"y", "rad", -0.5, 0.0, 0.5}},
    .sense = sense,
};
