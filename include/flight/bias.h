// bias.h - the accelerometer's bias, from the position as estimated, and the velocity without its share of
// it.
//
// An incremental law holds the measured acceleration, so that a bias b of the accelerometer becomes a
// standing error of -b/(kp kd), 2 cm for 0.01 g with the thesis's gains, and the estimator's velocity, fed by
// the same accelerometer, adds to it (thesis C.3). Per axis, with the position p as the measurement, an
// observer of position, velocity and bias with three poles at -w finds
//
//   b = (w / (s + w))^3 (a - p'')
//
// It is run as what that is, three lags in a row: none of them can diverge, at any pole and any interval dt.
// With the share g = 1 - exp(-w dt) of each, and r the change of p over the interval,
//
//   o = <a> - g/dt (r - <r>),   <o> += g (o - <o>),   b += g (<o> - b)      o: the bias behind one lag
//   <a> += g (a - <a>),   <r> += g (r - <r>)
//
// (r - <r>) g/dt is the same lag of the change of r, so that a motion that acceleration and position agree on
// cancels at any interval.
//
// The estimator's velocity v is held against the change of the position, over vel_s = T: it is wrong by
//
//   off += (1 - exp(-dt/T)) (v - r - off)
//
// (0.153 s x bias behind the firmware's Kalman filter, measured on sim/sense; 0 where only the
// controller's accelerometer is wrong).
//
// What the vehicle did in a gap longer than BIAS_GAP_S nobody knows, and a position that moves otherwise than
// the velocity by more than BIAS_JUMP_MPS was reset: of neither anything is learned.
#ifndef FLIGHT_BIAS_H
#define FLIGHT_BIAS_H

#include "flight/status.h"
#include "flight/v3.h"

#define BIAS_GAP_S    0.1f // the accelerometer's last sample does not stand for so long
#define BIAS_JUMP_MPS 5.0f // 5 cm in a period of the outer loop

typedef struct {
  float pole_radps; // 0: the bias is taken to be 0 and the velocity as it comes; else > 0
  float max_mps2;   // bound of the bias
  float vel_s;      // >= 0   time over which velocity and position are compared; 0: not
} bias_param_t;

typedef struct {
  v3_t bias_mps2, vel_off_mps;                  // what acceleration and velocity are wrong by
  v3_t pos_last_m;                              // at the last step
  v3_t acc_slow_mps2, vel_slow_mps, first_mps2; // <a>, <r>, <o>
} bias_t;

// What a step of this period does; made anew when parameters change.
typedef struct {
  float period_s, per_s;  // of a step, and its inverse
  float share, vel_share; // g, and 1 - exp(-dt/T)
} bias_coef_t;

// period_s: > 0.
void bias_tune(bias_coef_t *c, const bias_param_t *p, float period_s);

// No bias known. The position is that of one period before the first step.
void bias_start(bias_t *s, v3_t pos_m, v3_t vel_mps);

// One period. acc_mps2: measured, without gravity. All finite.
// ST_BAD_STATE: the state was none (a flipped bit); it starts afresh.
MUST_CHECK status_t bias_step(bias_t *s, const bias_param_t *p, const bias_coef_t *c, v3_t acc_mps2,
                              v3_t pos_m, v3_t vel_mps);

// The acceleration will come with this much more of bias along the world's z, known by somebody else until
// now. What it can hold it takes, and what it took is the result: whoever filters the acceleration shifts it
// by as much (sync_shift_acc).
float bias_take(bias_t *s, const bias_param_t *p, float more_mps2);

// The estimator's velocity without what it is wrong by.
v3_t bias_free_velocity(const bias_t *s, v3_t vel_mps);

// A known jump of the position's origin, which is no motion.
void bias_shift(bias_t *s, v3_t by_m);

#endif
