// kalman_z.h - height and climb from the accelerometer and the downward range sensor: a steady-state Kalman
// filter of two states, which behaves like the firmware's on the vertical axis.
//
//   each tick:   z += v dt + a dt^2/2,  v += a dt
//   each sample: z += k_z (range - z),  v += k_v (range - z)
#ifndef SIM_SENSE_KALMAN_Z_H
#define SIM_SENSE_KALMAN_Z_H

typedef struct {
  double k_z, k_v; // steady-state gains: no unit, 1/s
  double z_m, climb_mps;
} kalman_z_t;

// Starts at height z_m, at rest. acc_sd_mps2: what the filter expects of the accelerometer, > 0 (0.5 on the
// vertical axis); range_sd_m: > 0; period_s: > 0, of the prediction; every `ticks`-th is followed by a
// sample.
void kalman_z_init(kalman_z_t *k, double acc_sd_mps2, double range_sd_m, double period_s, int ticks,
                   double z_m);
void kalman_z_predict(kalman_z_t *k, double acc_mps2, double period_s);
void kalman_z_correct(kalman_z_t *k, double range_m);

#endif
