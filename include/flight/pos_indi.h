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
// so that neither an angle nor a matrix inverse is needed. The ceiling term acts on the thrust alone. The
// thrust increment is multiplied by `quick`, which makes the acceleration follow that many times faster than
// the motors: their first-order lag tau turns T + quick dT into a thrust that grows by quick dT / tau.
//
// dzc is the change of the distance from the instant of the filtered state until the motors have responded. w
// is the climb rate, w_c the wanted one, vel_sp + kp (z_sp - z):
//
//   LAW_THESIS     dzc = -lead w                                  thesis 5.1: lead 0.3 s, found by trial
//   LAW_PREDICTED  dzc = -(lag w + catch (w - w_c)),              lag = filter + tau / quick + period / 2
//
// In a hover the curve is a spring of negative stiffness: z'' = k z + ..., k = -g rho' / rho, 64 /s2 at 20 mm
// below the thesis's ceiling, 94 at 15 mm. The increment balances what the accelerometer has seen of it;
// during the lag the vehicle moves by lag w, and the spring adds k lag w. The prediction cancels that, up to
// its own error: if k or the lag is larger by a share e, a negative damping of k lag e remains. So the
// damping has to grow with k, too: `catch` adds k catch to kd, which is enough while catch > lag e. It acts
// on the unwanted climb only. The thesis's lead acts on all of the climb: it slows the approach, so that at
// 20 mm the last part is climbed at the rate kp kd / (kd + k lead), over 5 s, and its damping of 19 /s acts
// only after the whole lag.
#ifndef FLIGHT_POS_INDI_H
#define FLIGHT_POS_INDI_H

#include "flight/rbf.h"
#include "flight/v3.h"
#include <stdint.h>

typedef enum { LAW_THESIS, LAW_PREDICTED } pos_law_t;

typedef struct {
  float kp_per_s;     // > 0    x, y: wanted velocity per position error
  float kd_per_s;     // > 0    x, y: wanted acceleration per velocity error
  float kp_z_per_s;   // > 0    height: likewise
  float kd_z_per_s;   // > 0
  float quick;        // > 0    how many times faster than the motors the vertical acceleration follows
  float mass_kg;      // > 0
  int32_t law;        // pos_law_t
  float lead_s;       // >= 0   of LAW_THESIS, K_zdot
  float catch_s;      // >= 0   of LAW_PREDICTED
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

// Returns the acceleration that brings the vehicle to the set point:
// acc_sp + kd (vel_sp + kp (pos_sp - pos) - vel), each axis within +-acc_max_mps2.
v3_t pos_indi_wanted_acc(const pos_indi_param_t *p, const pos_setpoint_t *sp, v3_t pos_w_m, v3_t vel_w_mps);

// Returns dzc in m, at climb rate climb_mps while wanted_mps is wanted; a climb shortens the distance. In the
// header, because the call would cost more than the computation.
static inline float pos_indi_nearing_m(const pos_indi_param_t *p, float climb_mps, float wanted_mps,
                                       float lag_s) {
  if (p->law == LAW_THESIS) return -p->lead_s * climb_mps;
  return -(lag_s * climb_mps + p->catch_s * (climb_mps - wanted_mps));
}

// Returns the increment that changes the acceleration by acc_error_w_mps2, from the filtered attitude q_wb
// and the synchronous thrust_N, while the distance changes by dzc_m. `at`: ratio (> 0) and slope there.
pos_step_t pos_indi_step(const pos_indi_param_t *p, quat_t q_wb, float thrust_N, v3_t acc_error_w_mps2,
                         float dzc_m, rbf_point_t at);

// Returns the command: filtered attitude and synchronous thrust plus the increment, within the limits.
pos_command_t pos_indi_command(const pos_indi_param_t *p, quat_t q_wb, float thrust_N, pos_step_t step);

#endif
