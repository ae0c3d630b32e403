// imu.h - accelerometer and gyro at 1 kHz, as a Crazyflie 2.1 delivers them: a BMI088 behind second-order
// Butterworth low-passes (bilinear, cut-off prewarped). Delay at low frequency sqrt(2) / (2 pi cutoff): 7.5
// ms and 2.8 ms.
//
// Source: Crazyflie firmware 2a18fc29 (ranges, rates, cut-offs). A sample is clipped to the chip's range,
// then filtered. Neglected: the chip's rounding (0.7 mg, 0.06 deg/s), which is far below the noise before the
// filter, and its own low-pass (145 and 116 Hz, 1 to 2 ms more).
#ifndef SIM_SENSE_IMU_H
#define SIM_SENSE_IMU_H

#include "base/constants.h"
#include "base/random.h"
#include "sense/truth.h"

#define IMU_ACC_CUTOFF_HZ  30.0
#define IMU_GYRO_CUTOFF_HZ 80.0
#define IMU_ACC_MAX_MPS2   (24.0 * G_MPS2)
#define IMU_GYRO_MAX_RADPS (2000.0 * PI / 180.0)

// All zero: perfect. Standard deviations are those of FILTERED samples, each axis; the noise is white before
// the filter.
typedef struct {
  double acc_rest_mps2;               // sd with motors off
  double acc_xy_mps2, acc_z_mps2;     // sd with motors on
  double gyro_rest_radps;             // sd with motors off
  double gyro_xy_radps, gyro_z_radps; // sd with motors on
  d3_t acc_bias_b_mps2;               // remaining after the firmware has scaled |acc| to 1 g on the ground
  d3_t gyro_bias_b_radps;             // remaining after the firmware has subtracted the mean at rest
  double acc_scale, gyro_scale;       // relative error of the scale: 0.01 reads 1 % too much
  d3_t mount_rad;                     // small angle by which the chip's axes are turned from the body's
} imu_param_t;

typedef struct {
  double b0, a1, a2; // y = b0 (x + 2 x' + x'') - a1 y' - a2 y''
  double gain;       // sd of filtered over sd of raw white noise
} imu_filter_t;

typedef struct {
  double next, after; // contributions of earlier samples to the next output and to the one after it
} imu_memory_t;

typedef struct {
  imu_filter_t acc, gyro;
  imu_memory_t memory[6]; // acc x y z, gyro x y z
  bool started;
} imu_t;

typedef struct {
  d3_t acc_b_mps2; // specific force
  d3_t gyro_b_radps;
} imu_sample_t;

// The filters start settled on the first sample.
void imu_init(imu_t *s);

// One period of 1 ms. r: null for no noise.
imu_sample_t imu_step(imu_t *s, const imu_param_t *p, random_t *r, const truth_t *truth);

// The same with noise drawn before (random_triangles); null for none.
#define IMU_DRAWN 6
imu_sample_t imu_take(imu_t *s, const imu_param_t *p, const double *drawn, const truth_t *truth);

#endif
