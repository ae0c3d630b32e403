// pos_indi.h - outer loop: position to thrust direction and thrust, by incremental dynamic inversion.
//
// From m a = T rho(zc) b - m g e_z, b the thrust's direction, to first order about the filtered state
// (thesis eqs 13-17; eqs 16-17 are lost in print and were derived anew, src/README.md, reading rules):
//
//   m da = rho T db + rho b dT + T rho' b dzc
//
// With a = R' (wanted - filtered acceleration) in body axes and db = R (pitch, -roll, 0):
//
//   pitch = m a_x / (rho T),   roll = -m a_y / (rho T),   dT = (m a_z - T rho' dzc) / rho
//
// so that neither an angle nor a matrix inverse is needed. The ceiling term acts on the thrust alone.
// dzc = -lead_s x climb: what the distance will have changed by when the motors have answered (thesis 5.1).
#ifndef FLIGHT_POS_INDI_H
#define FLIGHT_POS_INDI_H

#include "flight/rbf.h"
#include "flight/v3.h"

typedef struct {
  float kp_per_s;     // > 0    wanted velocity per position error
  float kd_per_s;     // > 0    wanted acceleration per velocity error
  float mass_kg;      // > 0
  float lead_s;       // >= 0   the thesis's K_zdot
  float thrust_max_N; // > 0    of all motors together
  float thrust_floor; // 0..1   the divisor T is at least this share of m g (it is 0 on the ground)
  float tilt_max_rad; // 0..0.8 largest angle of the thrust's direction from vertical
  float acc_max_mps2; // > 0    bound of the wanted acceleration, each axis
} pos_indi_param_t;

typedef struct {
  v3_t pos_w_m;
  v3_t vel_w_mps;  // feed-forward
  v3_t acc_w_mps2; // feed-forward
} pos_setpoint_t;

typedef struct {
  float roll_rad, pitch_rad; // right-handed, about the body's x and y axis
  float thrust_N;
} pos_step_t;

typedef struct {
  v3_t up_w;      // direction of thrust, length 1
  float thrust_N; // of all motors together, 0..thrust_max_N
  bool at_limit;  // the law asked for less than 0 or more than thrust_max_N
} pos_command_t;

// The acceleration that brings the vehicle to the set point:
// acc_sp + kd (vel_sp + kp (pos_sp - pos) - vel), each axis within +-acc_max_mps2.
v3_t pos_indi_wanted_acc(const pos_indi_param_t *p, const pos_setpoint_t *sp, v3_t pos_w_m, v3_t vel_w_mps);

// The increment that changes the acceleration by acc_error_w_mps2, from the filtered attitude q_wb and the
// synchronous thrust_N, at a climb of climb_mps and the curve's value and slope `at` (ratio > 0).
pos_step_t pos_indi_step(const pos_indi_param_t *p, quat_t q_wb, float thrust_N, v3_t acc_error_w_mps2,
                         float climb_mps, rbf_point_t at);

// The increment applied to the filtered attitude and the synchronous thrust, within the limits.
pos_command_t pos_indi_command(const pos_indi_param_t *p, quat_t q_wb, float thrust_N, pos_step_t step);

#endif
