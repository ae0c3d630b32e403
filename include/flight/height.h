// height.h - height and climb from thrust, accelerometer and downward range sensor, in the estimator's place.
//
// The firmware's estimator does not know the thrust: what the accelerometer's noise makes of the climb, the
// law follows. This filter knows it. States: height h, climb w, a disturbing force d over the mass, and the
// accelerometer's bias b. T is the thrust that the motors give, the command behind its delay and their lag
// (thrust.h), up the cosine of the tilt, rho the ceiling's curve, z up:
//
//   h' = w,   w' = a = rho(zc) T up / m - g + d,   d' = walk n1,   b' = HEIGHT_BIAS_WALK n2    n: white, 1
//
// Measured, with e what is left over against what the filter expects:
//
//   e = acc - b - a(t - 7.5 ms)           every step, variance HEIGHT_ACC_VAR
//   e = range down - h(t - age)           a sample each 25 ms, variance HEIGHT_DOWN_VAR
//
// The firmware's low-pass of the accelerometer, a Butterworth of 30 Hz, is 1/(1 + s T + s2 T2/2 + ...) with
// T = sqrt(2)/(2 pi 30 Hz) = 7.5 ms: to the second order a pure delay of so long. It is taken as that,
// between the last step's acceleration and this one's; h is taken back by w and a.
//
// Nearer to the ceiling the curve pulls more: a grows by k with h, k = -g rho'/rho, so that P, the
// covariance, follows (to the first order in the step dt)
//
//   P <- F P F' + Q,   F = 1 + dt [0 1 0 0; k 0 1 0; 0 0 0 0; 0 0 0 0],   Q = dt diag(0, 0, walk^2, ..)
//   K = P H / (H' P H + R),   x += K e,   P -= K H' P     one measurement after the other: no matrix inverse
//
// with H = [k 0 1 1] of the accelerometer and [1 0 0 0] of the range. Gains of a far ceiling would not do: a
// height that is wrong by e feels k e, which grows faster than those take it back (measured: at 15 mm they
// touch in 10 of 40 flights, this in none).
//
// The height of the range sensor's floor may be another than the estimator's zero: off, the mean difference
// over HEIGHT_OFF_STEPS, is added.
//
// What it says is flown (height_fly) only while it fits: mean squares of e over its expected size of both
// sensors within HEIGHT_ODD, no three samples in a row beyond belief, none lost for HEIGHT_SILENT steps or
// alike for HEIGHT_SAME samples, a disturbing force that is none of contact, and the estimator within
// HEIGHT_APART_M. Else the last difference from the estimator fades out, in a quarter of a second, and with
// it the gains go back to those of the estimator's height; the filter starts afresh from the estimator. When
// it has fitted for `wait` steps, HEIGHT_FIT at first, it fades in. So neither is a step.
//
// A lag or a delay that is not what it was told is so for good: what flew by it and had to hand back would do
// so again and again, and each time two laws meet. So each time that what was flown did not fit, whatever it
// was, it waits twice as long, up to HEIGHT_FIT_MAX; half as long when it has fitted for HEIGHT_TRUST waits,
// the first of them not flown. Missed calls and inputs that are none say nothing against it: wait stays.
#ifndef FLIGHT_HEIGHT_H
#define FLIGHT_HEIGHT_H

#include "flight/pos_indi.h"
#include "flight/rbf.h"
#include "flight/v3.h"
#include <stdint.h>

typedef struct {
  int32_t own;     // 0: the law flies by the estimator's height and climb, 1: by this filter's while it fits
  float tau_s;     // > 0    first-order lag of the motors
  float delay_s;   // >= 0   of the command on its way to them
  float walk_mps2; // > 0    per root second: how fast the disturbing force changes
  float kp_per_s;  // > 0    gains of the law while it flies by this filter, as in pos_indi_param_t
  float kd_per_s;  // > 0
  float quick;     // > 0
  float catch_s;   // >= 0
} height_param_t;

#define HEIGHT_S          0.01f   // a step
#define HEIGHT_AHEAD_S    0.008f  // from a step to the outer loop's tick
#define HEIGHT_COMMAND_S  0.0095f // the command that is seen in a step was given so long after the one before
#define HEIGHT_DOWN_AGE_S 0.0175f // of a range sample in its step: 13 ms, and half the poll's 10 ms
#define HEIGHT_ACC_VAR    9.6e-3f // 0.078 m/s2, samples 10 ms apart alike by 0.3
#define HEIGHT_DOWN_VAR   6.33e-6f // 2.5 mm and whole millimetres
#define HEIGHT_BIAS_WALK  0.003f   // m/s2 per root second
#define HEIGHT_CLIMB_WALK 0.007f   // m/s per root second: what lag and delay are wrong by
#define HEIGHT_FORCE_MAX  1.2f   // m/s2: map, mass and gusts together are less, a push against a ceiling more
#define HEIGHT_BIAS_MAX   0.6f   // m/s2: three times what one comes with
#define HEIGHT_ODD        4.0f   // twice the expected size: no noise is, in the mean of a quarter of a second
#define HEIGHT_WILD       25.0f  // five standard deviations
#define HEIGHT_SILENT     10     // steps: four samples lost
#define HEIGHT_SAME       10     // samples after the first: noise moves them sooner
#define HEIGHT_FIT        50     // steps: twice the mean squares' time
#define HEIGHT_FIT_MAX    1600   // steps: 16 s, so that who flies for a minute has seldom two laws that meet
#define HEIGHT_TRUST      8      // waits: in the corners 12 of 4,300 flights touched without, with it none
#define HEIGHT_OFF_STEPS  400    // 4 s: slower than the law, faster than the estimator drifts
#define HEIGHT_APART_M    0.015f // five times what the estimator is wrong by; a floor that is another is more
#define HEIGHT_APART_MPS  0.15f  // likewise of its climb

typedef struct {
  v3_t acc_b_mps2;         // specific force: +9.81 on z at rest
  quat_t q_wb;             // body to world, length 1
  float thrust_N, mass_kg; // what is applied now; > 0
  float z_m, climb_mps;    // the estimator's
  rbf_point_t at;          // the curve at zc_m, the ground's share in its value
  float ground_excess;     // that share
  float zc_m, ceiling_z_m; // NaN: none known
  float down_m;            // downward range sensor, along the body's z axis; 0: no new sample
  float bias_mps2;         // the accelerometer's along the world's z, to begin with
} height_in_t;

enum { HEIGHT_H, HEIGHT_W, HEIGHT_D, HEIGHT_B, HEIGHT_N };

typedef struct {
  float x[HEIGHT_N];           // h, w, d, b
  float P[HEIGHT_N][HEIGHT_N]; // their covariance; both triangles
  float off_m;                 // the estimator's height is so much more
  int off_steps;               // that made it
  float thrust_N;              // T
  float sent_N[3];             // the commands of the last steps
  float acc_mps2;              // a of the last step
  float acc_odd, down_odd;     // mean squares of e over its expected size; 1 where all fits
  float down_last_m;
  int same, silent, wild; // samples alike; steps without one; samples in a row that are not believed
  int fit;                // steps since something did not fit, up to HEIGHT_TRUST times wait
  int wait;               // steps that it has to have fitted to be flown
  float share;            // of this filter in what is flown
  float more_m, more_mps; // than the estimator's
  bool started;
} height_t;

// What the law flies by.
typedef struct {
  float more_m, more_mps; // height and climb are so much more than the estimator's
  pos_indi_param_t law;   // with the gains that belong to it
} height_fly_t;

// Nothing known: what is flown is the estimator's.
static inline void height_init(height_t *s) {
  *s = (height_t){.wait = HEIGHT_FIT};
}

// Nothing of the last steps is known any more; what is flown fades out. wait stays.
static inline void height_lose(height_t *s) {
  s->started = false;
  s->fit = 0;
}

// One step. motor_share: thrust_lag_share(HEIGHT_S, tau_s). What is not finite, or beyond any flight, is
// taken for a sensor that is lost.
void height_step(height_t *s, const height_param_t *p, float motor_share, const height_in_t *in);

// HEIGHT_AHEAD_S later, where the estimator says z_m and climb_mps (finite).
void height_fly(height_t *s, const height_param_t *p, const pos_indi_param_t *law, float z_m, float climb_mps,
                height_fly_t *fly);

#endif
