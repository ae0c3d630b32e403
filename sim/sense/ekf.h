// ekf.h - what the firmware's Kalman filter makes of the inertial, downward range and flow sensors: position,
// velocity and attitude with its rates, delays, noise expectations and errors. It never sees the upward
// range.
//
// State: position p (world), velocity v (body), attitude error d (body, shifted into the quaternion each ms).
// R turns body into world, u = R' e3, f specific force, w body rates, g = 9.81:
//
//   p' = R (I + [d]) v,   v' = f - w x v - g (I - [d]) u,   d' = - w/2 x d
//
//   each 10 ms   prediction with the mean of f and w over the ten samples before. In flight f = (0, 0, fz):
//                the flow alone corrects the attitude. On the ground all of f, and the attitude goes back
//                to level and to the first yaw by 0.1 % each time
//   each 1 ms    process noise, (acc * 1 ms)^2 of velocity and so on: a stiffer filter than the same
//                numbers at 100 Hz would make
//   range        h = z / cos(max(tilt - 7.5 deg, 0)); ignored from 5 m and beyond 84 deg of tilt
//   flow         h = (v_x R33 / max(z, 0.1 m) - w_y) dt, y alike; w: newest sample; ignored from 100 counts
//   pose         of motion capture: h = p, and h = d for the attitude it says against the present one
//   then         d is shifted into the attitude if one part of it exceeds 1e-4 rad, else DROPPED: without
//                noise a quarter of a degree of tilt, and 2 cm/s with it, can stay for ever
//   always       variances stay in 1e-6 to 100; beyond 100 m or 10 m/s the filter starts anew
//
// No drag. What a call returns was finished in the call before it. Mean lags: height 16 ms in a steady climb
// (the range's age is not accounted for), attitude 9 ms.
//
// A constant error b of the vertical accelerometer in hover near the ground, with q = acc_z^2 * 1 ms and
// r = range^2 * 25 ms as densities and W = (q / r)^(1/4) = 8.94 1/s:
//
//   climb is wrong by b sqrt(2) / W = 0.158 s * b,  height by b / W^2 = 0.0125 s2 * b
//
// (0.153 and 0.0122 in discrete time). A loop with a_wanted = Kd (Kp e - climb) then hovers wrong by
// -(b / Kd + 0.153 b) / Kp - 0.0122 b.
//
// Source: Mueller, Hamer, D'Andrea 2015; Mueller, Hehn, D'Andrea 2016; rates, numbers and limits: Crazyflie
// firmware 2a18fc29. Own code.
#ifndef SIM_SENSE_EKF_H
#define SIM_SENSE_EKF_H

#include "sense/imu.h"
#include <stdbool.h>

#define EKF_N   9
#define EKF_ROW 10 // of a matrix: columns in pairs

// What the filter expects, as standard deviations.
typedef struct {
  double acc_xy_mps2, acc_z_mps2; // acceleration that it does not know of
  double gyro_radps;
  double range_m;          // downward range near the ground; grows with the distance
  double flow_counts;      // each axis
  double pose_m, pose_rad; // motion capture: each axis
  double reversion;        // share of the attitude that goes back to level, each prediction on the ground
} ekf_param_t;

extern const ekf_param_t ekf_firmware;

typedef struct {
  imu_sample_t imu; // specific force and rates, filtered as the firmware does
  bool motors;      // above idle; flight lasts until 2 s after
  bool range_new;
  double range_m; // downward
  bool flow_new;
  double flow_x, flow_y, flow_span_s; // counts over span; forward flight: x > 0
  bool pose_new;                      // from motion capture
  d3_t pose_m;
  dq_t pose_q;
} ekf_in_t;

// As the firmware's state_t, but in SI.
typedef struct {
  d3_t pos_w_m, vel_w_mps;
  dq_t q_wb;
} ekf_out_t;

typedef struct {
  ekf_param_t param;
  double s[EKF_N];                       // p, v, d
  _Alignas(16) double P[EKF_N][EKF_ROW]; // variance; the upper triangle
  double R[3][3];
  dq_t q, q_start;
  imu_sample_t sum; // of the samples since the last prediction
  imu_sample_t imu; // newest sample
  ekf_out_t out;
  int samples;      // in the sums
  int noise_ms;     // process noise not yet added
  int countdown_ms; // to the next prediction
  int flying_ms;    // left of the flight
  int resets;       // how often the state was out of bounds
  bool updated;
} ekf_t;

// At rest on the ground at the origin, level, nose at yaw_rad. range_m of the parameter > 0.
void ekf_init(ekf_t *e, const ekf_param_t *p, double yaw_rad);

// Flies there already: position, velocity and attitude are known to about 1 mm, 1 cm/s and 0.01 rad.
void ekf_place(ekf_t *e, d3_t pos_w_m, d3_t vel_w_mps, dq_t q_wb);

// One period of 1 ms. Inputs must be finite. What the firmware hands out in this period is e->out before the
// call.
void ekf_update(ekf_t *e, const ekf_in_t *in);

// The same, and what is handed out.
ekf_out_t ekf_step(ekf_t *e, const ekf_in_t *in);

// --- the inside: the steps of the filter (ekf_core.c) ----------------------------------------------------

// Brings e->R up to date with e->q.
void ekf_core_rotation(ekf_t *e);

// Adds the process noise of the e->noise_ms that are due.
void ekf_core_noise(ekf_t *e);

// State and variance dt_s later; acc and gyro: means over that time.
void ekf_core_predict(ekf_t *e, d3_t acc_b_mps2, d3_t gyro_b_radps, double dt_s, bool flying);

void ekf_core_range(ekf_t *e, double range_m);
void ekf_core_flow(ekf_t *e, double counts_x, double counts_y, double span_s);
void ekf_core_pose(ekf_t *e, d3_t pos_w_m, dq_t q_wb);

// After prediction or correction: shifts the attitude error into the attitude.
void ekf_core_finish(ekf_t *e);

#endif
