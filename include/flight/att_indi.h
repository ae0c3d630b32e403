// att_indi.h - inner loop: attitude to body torques, by incremental dynamic inversion (thesis eqs 3-12).
//
//   rate wanted = kp e,  nu = kd (rate wanted - rate),   e: rotation vector from attitude to wanted attitude
//   roll, pitch:  tau = tau_f + [quick J (nu - rate'_f) + k lag rate] / ratio
//   yaw:          tau = tau_f + [quick J (nu - rate'_f) + g (tau_a - tau_f)_last] / (1 + g)
//                 g = g2 / period
//
// tau_a is the torque that was applied, after mixing (which gives up yaw first). tau_f is the torque that the
// rotors give now: tau_a through the motor lag and the filter of the differentiated gyro, so that both are
// from the same instant. g2 is the time by which the rotors' inertia leads their drag in yaw: J rate' = tau +
// g2 tau' (thesis eq. 12; in eqs 9 to 11 the period and a sign are misprinted).
//
// quick 1 is the law as printed: rate' follows nu with the motors' lag T, and the loop T s^3 + s^2 + kd s +
// kd kp = 0 is hardly damped (damping ratio 0.16 for kp 5, kd 24, T 80 ms with 13 ms of delay and 8 Hz), and
// unstable for lags from 1.45 T on. quick > 1 puts a lead into the increment and makes the lag T / quick.
// With kp 5, kd 12, quick 2 and 20 Hz the damping ratio is 0.7, and the loop is stable for lags from below
// T / 4 to 2.9 T.
//
// k is the thesis's ceiling term (eq. 15) for each rotor alone: a tilt by a brings the rotors of one side
// nearer to the ceiling by arm a, so that the torque grows by -k a, k = T rho' arm^2 <= 0. That is an
// inverted pendulum, 11 rad/s at 2 cm, which the increment sees late by lag, the motors' and the filter's
// together. The term is bounded, so that a wrong curve cannot make the loop unstable in free air (from 2.1 on
// it would; in contact, 1.5 is needed).
//
// The same law is tau = J (rate'_f + quick (nu - rate'_f)) + d with d = tau_f - J rate'_f, the external
// torque that the increments have come to balance. The rotors cause part of it: a weak motor, the centre of
// mass beside the middle, a bent blade, the flapping of blades. That part is a share of arm x thrust. A
// contact (a floor, a ceiling, a wall, a hand) has no bound: the increments would wind up against it, and the
// mixer would raise the thrust to make room for them. So d counts only within trim x arm x thrust, in yaw
// within trim times the rotors' torque. With trim < 0.5 both axes together stay below the torque that the
// thrust has room for, so that balancing d raises no thrust. While d is within, the law is the printed one to
// the bit.
// A motor 20 % weak needs a trim of 0.05, a centre of mass 5 mm off both axes 0.15, and 0.23 in a turn.
#ifndef FLIGHT_ATT_INDI_H
#define FLIGHT_ATT_INDI_H

#include "flight/lpf2.h"
#include "flight/trig.h"
#include "flight/v3.h"

#define ATT_INDI_CEILING_MAX 1.6f // of the damping quick J kd: the most that the ceiling term adds

typedef struct {
  float kp_per_s;     // > 0   roll and pitch: wanted rate per angle
  float kd_per_s;     // > 0   roll and pitch: wanted angular acceleration per rate error
  float kp_yaw_per_s; // > 0
  float kd_yaw_per_s; // > 0
  float inertia_xx_kgm2, inertia_yy_kgm2, inertia_zz_kgm2; // > 0
  float g2_s;                                              // >= 0
  float rate_max_radps;                                    // > 0  bound of the wanted rates
  float quick; // > 0  how many times faster than the motors the acceleration is to follow
  float trim;  // 0..0.5  largest external torque that is balanced, over arm x thrust
} att_indi_param_t;

typedef struct {
  lpf2_t acc[3], torque[3]; // filters of the angular acceleration and of the applied torque
  v3_t torque_model_Nm;     // what the motors give, lag included
  v3_t rate_last_radps;
  float yaw_now_Nm; // what the motors gave in yaw at the last step
  bool started;
} att_indi_t;

typedef struct {
  v3_t rate_b_radps;
  quat_t q_wb, q_ref;   // attitude and the wanted one, body to world
  float yaw_rate_radps; // wanted in addition to the rate by the yaw error
  v3_t torque_b_Nm;     // applied since the last call, after mixing
  float ceiling_Nms;    // <= 0   k lag: torque about x and y per rate; 0: no ceiling
  float ratio;          // > 0    thrust over thrust in free air
  float trim_Nm;        // >= 0   largest external torque that is balanced about x and y
  float trim_yaw_Nm;    // >= 0   about z
} att_indi_in_t;

// Forgets everything; the next step starts from its inputs.
void att_indi_reset(att_indi_t *s);

// True if no bit flip shows in the state (lpf2_sum).
bool att_indi_good(const att_indi_t *s);

// Returns the wanted torque, body axes. lag_share: of the motors in one period (thrust_lag_share).
v3_t att_indi_step(att_indi_t *s, const att_indi_param_t *p, const lpf2_coef_t *c, float lag_share,
                   float period_s, const att_indi_in_t *in);

// Returns the shortest rotation from q_wb to q_ref, body axes, as twice the vector part of its quaternion: 2
// sin(angle/2) long, at most 2; for small angles the rotation vector in rad.
static ALWAYS_INLINE v3_t att_indi_error(const quat_t *q_wb, const quat_t *q_ref) {
  const quat_t e = quat_mul(quat_conj(*q_wb), *q_ref);
  // q and -q are the same attitude: the shorter way round.
  const float k = e.w < 0.0f ? -2.0f : 2.0f;
  return (v3_t){k * e.x, k * e.y, k * e.z};
}

// Returns the attitude whose thrust points along up_w (length 1, up_w.z > 0), with the given heading (sine
// and cosine of the yaw).
quat_t att_indi_reference(v3_t up_w, sincos_t heading);

#endif
