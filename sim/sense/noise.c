// noise.c - levels of noise.
#include "sense/noise.h"

#include "base/constants.h"
#include <stddef.h>
#include <string.h>

#define DEG RAD_PER_DEG

const noise_t noise_levels[] = {
    {.name = "quiet", .range = {.down_cone_rad = 7.5 * DEG}},
    {.name = "real",
     .imu = {.acc_rest_mps2 = 0.0012 * G_MPS2,
             .acc_xy_mps2 = 0.016 * G_MPS2,
             .acc_z_mps2 = 0.008 * G_MPS2,
             .gyro_rest_radps = 0.14 * DEG,
             .gyro_xy_radps = 1.0 * DEG,
             .gyro_z_radps = 0.5 * DEG},
     .range =
         {.up_m = 0.003, .down_m = 0.0025, .down_cone_rad = 7.5 * DEG, .flow_counts = 2.0, .rounding = 1.0}},
};
const int noise_count = (int)(sizeof noise_levels / sizeof *noise_levels);

const noise_field_t noise_fields[] = {
    {"acc.rest", "m/s2", 0.0, 10.0, offsetof(noise_t, imu.acc_rest_mps2), "sd, motors off"},
    {"acc.xy", "m/s2", 0.0, 10.0, offsetof(noise_t, imu.acc_xy_mps2), "sd of x and y, motors on"},
    {"acc.z", "m/s2", 0.0, 10.0, offsetof(noise_t, imu.acc_z_mps2), "sd of z, motors on"},
    {"acc.bias.x", "m/s2", -10.0, 10.0, offsetof(noise_t, imu.acc_bias_b_mps2.x), "constant error"},
    {"acc.bias.y", "m/s2", -10.0, 10.0, offsetof(noise_t, imu.acc_bias_b_mps2.y), "constant error"},
    {"acc.bias.z", "m/s2", -10.0, 10.0, offsetof(noise_t, imu.acc_bias_b_mps2.z), "constant error"},
    {"acc.scale", "", -0.2, 0.2, offsetof(noise_t, imu.acc_scale), "relative error of the scale"},
    {"gyro.rest", "rad/s", 0.0, 10.0, offsetof(noise_t, imu.gyro_rest_radps), "sd, motors off"},
    {"gyro.xy", "rad/s", 0.0, 10.0, offsetof(noise_t, imu.gyro_xy_radps), "sd of x and y, motors on"},
    {"gyro.z", "rad/s", 0.0, 10.0, offsetof(noise_t, imu.gyro_z_radps), "sd of z, motors on"},
    {"gyro.bias.x", "rad/s", -1.0, 1.0, offsetof(noise_t, imu.gyro_bias_b_radps.x), "constant error"},
    {"gyro.bias.y", "rad/s", -1.0, 1.0, offsetof(noise_t, imu.gyro_bias_b_radps.y), "constant error"},
    {"gyro.bias.z", "rad/s", -1.0, 1.0, offsetof(noise_t, imu.gyro_bias_b_radps.z), "constant error"},
    {"gyro.scale", "", -0.2, 0.2, offsetof(noise_t, imu.gyro_scale), "relative error of the scale"},
    {"mount.x", "rad", -0.2, 0.2, offsetof(noise_t, imu.mount_rad.x), "chip turned about x"},
    {"mount.y", "rad", -0.2, 0.2, offsetof(noise_t, imu.mount_rad.y), "chip turned about y"},
    {"mount.z", "rad", -0.2, 0.2, offsetof(noise_t, imu.mount_rad.z), "chip turned about z"},
    {"up", "m", 0.0, 1.0, offsetof(noise_t, range.up_m), "sd of the upward range"},
    {"down", "m", 0.0, 1.0, offsetof(noise_t, range.down_m), "sd of the downward range near the ground"},
    {"up.cone", "rad", 0.0, 0.5, offsetof(noise_t, range.up_cone_rad), "half the upward sensor's view"},
    {"down.cone", "rad", 0.0, 0.5, offsetof(noise_t, range.down_cone_rad), "half the downward sensor's view"},
    {"flow", "counts", 0.0, 100.0, offsetof(noise_t, range.flow_counts), "sd of the flow, each axis"},
    {"rounding", "", 0.0, 1.0, offsetof(noise_t, range.rounding), "1: whole millimetres and counts"},
};
const int noise_field_count = (int)(sizeof noise_fields / sizeof *noise_fields);

const noise_t *noise_find(const char *name) {
  for (int i = 0; i < noise_count; i++)
    if (strcmp(noise_levels[i].name, name) == 0) return &noise_levels[i];
  return NULL;
}

bool noise_set(noise_t *noise, const char *field, double value) {
  for (int i = 0; i < noise_field_count; i++) {
    const noise_field_t *f = &noise_fields[i];
    if (strcmp(f->name, field) != 0) continue;
    if (!(value >= f->min && value <= f->max)) return false;
    memcpy((char *)noise + f->offset, &value, sizeof value);
    return true;
  }
  return false;
}
