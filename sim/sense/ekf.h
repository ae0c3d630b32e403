// ekf.h - the firmware's Kalman filter: position, velocity and attitude from the inertial, downward range and
// flow sensors, with its rates, delays, noise expectations and errors. It never sees the upward range.
//
// State: position p (world), velocity v (body), attitude error d (body, shifted into the quaternion each ms).
// R turns body into world, u = R' e3, f specific force, w body rates, g = 9.81:
//
//   p' = R (I + [d]) v,   v' = f - w x v - g (I - [d]) u,   d' = - w/2 x d
//
//   each 10 ms   prediction with the mean of f and w over the ten samples before. In flight f = (0, 0, fz):
//                the flow alone corrects the attitude. On the ground all of f is used, and each prediction
//                moves the attitude by 0.1 % towards level and the first yaw
//   each 1 ms    process noise, (acc * 1 ms)^2 for the velocity and so on: the filter is stiffer than the
//                same numbers at 100 Hz would make it
//   range        h = z / cos(max(tilt - 7.5 deg, 0)); ignored from 5 m and beyond 84 deg of tilt
//   flow         h = (v_x R33 / max(z, 0.1 m) - w_y) dt, y alike; w: newest sample; ignored from 100 counts
//   pose         from motion capture: h = p, and h = d for its attitude relative to the estimated one
//   then         d is shifted into the attitude if one component exceeds 1e-4 rad, else DROPPED: without
//                noise, a quarter of a degree of tilt, and 2 cm/s with it, can stay for ever
//   always       variances stay in 1e-6 to 100; beyond 100 m or 10 m/s the filter starts anew
//
// No drag. A call returns what the call before it finished. Mean lags: height 16 ms in a steady climb (the
// range's age is not accounted for), attitude 9 ms.
//
// Effect of a constant error b of the vertical accelerometer in hover near the ground, with the densities
// q = acc_z^2 * 1 ms and r = range^2 * 25 ms, and W = (q / r)^(1/4) = 8.94 1/s:
//
//   climb error b sqrt(2) / W = 0.158 s * b,  height error b / W^2 = 0.0125 s2 * b
//
// (0.153 and 0.0122 in discrete time). A loop with a_wanted = Kd (Kp e - climb) then has a hover error of
// -(b / Kd + 0.153 b) / Kp - 0.0122 b.
//
// Source: Mueller, Hamer, D'Andrea 2015; Mueller, Hehn, D'Andrea 2016; rates, numbers and limits: Crazyflie
// firmware 2a18fc29. Own code.
#ifndef SIM_SENSE_EKF_H
#define SIM_SENSE_EKF_H

#include "sense/imu.h"
#include <stdbool.h>

#define EKF_N   9
#define EKF_ROW 10 // columns of a matrix, padded to pairs

// What the filter expects, as standard deviations.
typedef struct {
  double acc_xy_mps2, acc_z_mps2; // unmodelled acceleration
  double gyro_radps;
  double range_m;          // downward range near the ground; grows with distance
  double flow_counts;      // each axis
  double pose_m, pose_rad; // motion capture: each axis
  double reversion;        // share by which a prediction on the ground moves the attitude to level
} ekf_param_t;

extern const ekf_param_t ekf_firmware;

typedef struct {
  imu_sample_t imu; // specific force and rates, filtered as the firmware does
  bool motors;      // above idle; a flight lasts until 2 s after
  bool range_new;
  double range_m; // downward
  bool flow_new;
  double flow_x, flow_y, flow_span_s; // counts over span; forward flight: x > 0
  bool pose_new;                      // from motion capture
  d3_t pose_m;
  dq_t pose_q;
} ekf_in_t;

// As the firmware's state_t, but in SI units.
typedef struct {
  d3_t pos_w_m, vel_w_mps;
  dq_t q_wb;
} ekf_out_t;

typedef struct {
  ekf_param_t param;
  double s[EKF_N];                       // p, v, d
  _Alignas(16) double P[EKF_N][EKF_ROW]; // covariance; upper triangle
  double R[3][3];
  dq_t q, q_start;
  imu_sample_t sum; // of the samples since the last prediction
  imu_sample_t imu; // newest sample
  ekf_out_t out;
  int samples;      // number of samples in `sum`
  int noise_ms;     // process noise not yet added
  int countdown_ms; // to the next prediction
  int flying_ms;    // time left until the flight counts as over
  int resets;       // how often the state was out of bounds
  bool updated;
} ekf_t;

// Starts at rest on the ground at the origin, level, nose at yaw_rad. p->range_m > 0.
void ekf_init(ekf_t *e, const ekf_param_t *p, double yaw_rad);

// Starts in flight: position, velocity and attitude are known to about 1 mm, 1 cm/s and 0.01 rad.
void ekf_place(ekf_t *e, d3_t pos_w_m, d3_t vel_w_mps, dq_t q_wb);

// One period of 1 ms. Inputs must be finite. What the firmware outputs in this period is e->out before the
// call.
void ekf_update(ekf_t *e, const ekf_in_t *in);

// The same; returns that output.
ekf_out_t ekf_step(ekf_t *e, const ekf_in_t *in);

// --- internal: the steps of the filter (ekf_core.c) ------------------------------------------------------

// Updates e->R from e->q.
void ekf_core_rotation(ekf_t *e);

// Adds the process noise of the last e->noise_ms.
void ekf_core_noise(ekf_t *e);

// Advances state and covariance by dt_s. acc and gyro: means over that time.
void ekf_core_predict(ekf_t *e, d3_t acc_b_mps2, d3_t gyro_b_radps, double dt_s, bool flying);

void ekf_core_range(ekf_t *e, double range_m);
void ekf_core_flow(ekf_t *e, double counts_x, double counts_y, double span_s);
void ekf_core_pose(ekf_t *e, d3_t pos_w_m, dq_t q_wb);

// Call it after predictions or corrections: shifts the attitude error into the attitude.
void ekf_core_finish(ekf_t *e);

#endif
