// bias.h - the accelerometer's bias, from the estimated position, and the velocity without the bias's share.
//
// An incremental law controls the measured acceleration, so that an accelerometer bias b causes a standing
// error of -b/(kp kd), 2 cm for 0.01 g with the thesis's gains. The estimator's velocity, fed by the same
// accelerometer, adds to it (thesis C.3). Per axis, with the position p as the measurement, an observer of
// position, velocity and bias with three poles at -w gives
//
//   b = (w / (s + w))^3 (a - p'')
//
// It is computed as three lags in series, none of which can diverge, at any pole and any interval dt. With
// the share g = 1 - exp(-w dt) of each lag, and r the mean velocity of p over the interval,
//
//   o = <a> - g/dt (r - <r>),   <o> += g (o - <o>),   b += g (<o> - b)      o: the bias after one lag
//   <a> += g (a - <a>),   <r> += g (r - <r>)
//
// (r - <r>) g/dt is the derivative of r after the same lag, so that a motion on which acceleration and
// position agree cancels at any interval.
//
// The estimator's velocity v is compared with the change of the position, over vel_s = T. Its error is
//
//   off += (1 - exp(-dt/T)) (v - r - off)
//
// (0.153 s x bias with the firmware's Kalman filter, measured on sim/sense; 0 if only the controller's
// accelerometer is wrong).
//
// Two cases teach nothing: a gap longer than BIAS_GAP_S, in which the motion is not known, and a position
// whose change differs from the velocity by more than BIAS_JUMP_MPS, which was reset.
#ifndef FLIGHT_BIAS_H
#define FLIGHT_BIAS_H

#include "flight/status.h"
#include "flight/v3.h"

#define BIAS_GAP_S    0.1f // one sample of the accelerometer does not stand for a longer time
#define BIAS_JUMP_MPS 5.0f // 5 cm in a period of the outer loop

typedef struct {
  float pole_radps; // 0: the bias is taken to be 0 and the velocity as it comes; else > 0
  float max_mps2;   // bound of the bias
  float vel_s;      // >= 0   time over which velocity and position are compared; 0: not
} bias_param_t;

typedef struct {
  v3_t bias_mps2, vel_off_mps;                  // errors of acceleration and velocity
  v3_t pos_last_m;                              // at the last step
  v3_t acc_slow_mps2, vel_slow_mps, first_mps2; // <a>, <r>, <o>
} bias_t;

// Coefficients of a step of this period; recomputed when parameters change.
typedef struct {
  float period_s, per_s;  // of a step, and its inverse
  float share, vel_share; // g, and 1 - exp(-dt/T)
} bias_coef_t;

// Computes the coefficients. period_s: > 0.
void bias_tune(bias_coef_t *c, const bias_param_t *p, float period_s);

// Starts with no bias known. pos_m: the position one period before the first step.
void bias_start(bias_t *s, v3_t pos_m, v3_t vel_mps);

// Runs one period. acc_mps2: measured, without gravity. All inputs finite.
// ST_BAD_STATE: a flipped bit had spoilt the state; it has restarted.
MUST_CHECK status_t bias_step(bias_t *s, const bias_param_t *p, const bias_coef_t *c, v3_t acc_mps2,
                              v3_t pos_m, v3_t vel_mps);

// Takes over more_mps2 of bias along the world's z that the caller has removed until now and will leave in
// the acceleration. Returns the part that fits within max_mps2; the caller shifts the filtered acceleration
// by as much (sync_shift_acc).
float bias_take(bias_t *s, const bias_param_t *p, float more_mps2);

// Returns the estimator's velocity without its error.
v3_t bias_free_velocity(const bias_t *s, v3_t vel_mps);

// Takes in a known jump of the position's origin, which is not a motion.
void bias_shift(bias_t *s, v3_t by_m);

#endif
