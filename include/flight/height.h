// height.h - height and climb from thrust, accelerometer and downward range sensor, in the estimator's place.
//
// The firmware's estimator does not know the thrust, so that noise of the accelerometer becomes noise of the
// climb rate, which the law follows. This Kalman filter knows the thrust. States: height h, climb rate w,
// a disturbing force d over the mass, and accelerometer bias b. T is the thrust that the motors give: the
// command after its delay and their lag (thrust.h). up is the cosine of the tilt, rho the ceiling's curve, z
// up:
//
//   h' = w,   w' = a = rho(zc) T up / m - g + d,   d' = walk n1,   b' = HEIGHT_BIAS_WALK n2    n: white, 1
//
// Measurements, with the innovation e:
//
//   e = acc - b - a(t - 7.5 ms)           every step, variance HEIGHT_ACC_VAR
//   e = range down - h(t - age)           a sample each 25 ms, variance HEIGHT_DOWN_VAR
//
// The firmware's low-pass of the accelerometer, a Butterworth of 30 Hz, is 1/(1 + s T + s2 T2/2 + ...) with T
// = sqrt(2)/(2 pi 30 Hz) = 7.5 ms: to second order a pure delay of T. It is modelled as one, by interpolation
// between the last step's acceleration and this one's. For the range, h is moved back in time with w and a.
//
// Near the ceiling a grows by k with h, k = -g rho'/rho, so that to first order in the step dt the covariance
// P follows
//
//   P <- F P F' + Q,   F = 1 + dt [0 1 0 0; k 0 1 0; 0 0 0 0; 0 0 0 0],   Q = dt diag(0, 0, walk^2, ..)
//   K = P H / (H' P H + R),   x += K e,   P -= K H' P     one measurement after the other: no matrix inverse
//
// with H = [k 0 1 1] for the accelerometer and [1 0 0 0] for the range. The gains of a far ceiling do not
// suffice: a height error e changes a by k e, and so grows faster than those gains correct it (measured: at
// 15 mm they touch in 10 of 40 flights, these in none).
//
// The floor under the range sensor may not be the estimator's zero: off, their mean difference over
// HEIGHT_OFF_STEPS, is added to h.
//
// The filter is flown (height_fly) only while it fits: for both sensors the mean of e^2 over its variance is
// below HEIGHT_ODD; fewer than three range samples in a row are rejected (HEIGHT_WILD); the last one is not
// older than HEIGHT_SILENT steps, and they are not alike for HEIGHT_SAME samples; the disturbing force is
// smaller than a contact's; and the estimator is within HEIGHT_APART_M and HEIGHT_APART_MPS. Otherwise the
// last difference from the estimator fades out in a quarter of a second, and with it the filter's gains, and
// the filter restarts from the estimator. When it has fitted for `wait` steps, HEIGHT_FIT at first, it fades
// in. So neither change is a step.
//
// A lag or a delay that was told wrong stays wrong: the filter would be flown and handed back again and
// again, each time with a change of the law. So each time that it does not fit while it is flown, for
// whatever reason, `wait` doubles, up to HEIGHT_FIT_MAX. It halves when the filter has fitted for
// HEIGHT_TRUST waits, the first of them not flown. Missed calls and invalid inputs leave `wait` as it is.
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

#define HEIGHT_S          0.01f    // of a step
#define HEIGHT_AHEAD_S    0.008f   // from a step to the outer loop's tick
#define HEIGHT_COMMAND_S  0.0095f  // from a step to the command that the next step sees
#define HEIGHT_DOWN_AGE_S 0.0175f  // age of a range sample in its step: 13 ms, and half the poll's 10 ms
#define HEIGHT_ACC_VAR    9.6e-3f  // of 0.078 m/s2, samples 10 ms apart correlated by 0.3
#define HEIGHT_DOWN_VAR   6.33e-6f // of 2.5 mm, and of rounding to whole millimetres
#define HEIGHT_BIAS_WALK  0.003f   // m/s2 per root second
#define HEIGHT_CLIMB_WALK 0.007f   // m/s per root second: for errors of lag and delay
#define HEIGHT_FORCE_MAX  1.2f  // m/s2: errors of map and mass with gusts are less, a push at a ceiling more
#define HEIGHT_BIAS_MAX   0.6f  // m/s2: three times the bias that a sensor comes with
#define HEIGHT_ODD        4.0f  // twice the expected size: noise does not reach it in the mean of 0.25 s
#define HEIGHT_WILD       25.0f // five standard deviations, squared
#define HEIGHT_SILENT     10    // steps: four samples lost
#define HEIGHT_SAME       10    // samples after the first: noise changes them sooner
#define HEIGHT_FIT        50    // steps: twice the averaging time of the mean squares
#define HEIGHT_FIT_MAX    1600  // steps: 16 s, so that a flight of a minute seldom changes its law
#define HEIGHT_TRUST      8     // waits: of 4,300 flights with a wrong plant 12 touched without, none with it
#define HEIGHT_OFF_STEPS  400   // 4 s: slower than the law, faster than the estimator drifts
#define HEIGHT_APART_M    0.015f // five times the estimator's error; another floor differs by more
#define HEIGHT_APART_MPS  0.15f  // five times the error of its climb rate

typedef struct {
  v3_t acc_b_mps2;         // specific force: +9.81 on z at rest
  quat_t q_wb;             // body to world, length 1
  float thrust_N, mass_kg; // applied now; > 0
  float z_m, climb_mps;    // the estimator's
  rbf_point_t at;          // the curve at zc_m; its ratio includes the ground's share
  float ground_excess;     // that share
  float zc_m, ceiling_z_m; // NaN: none known
  float down_m;            // downward range sensor, along the body's z axis; 0: no new sample
  float bias_mps2;         // initial bias of the accelerometer along the world's z
} height_in_t;

enum { HEIGHT_H, HEIGHT_W, HEIGHT_D, HEIGHT_B, HEIGHT_N };

typedef struct {
  float x[HEIGHT_N];           // h, w, d, b
  float P[HEIGHT_N][HEIGHT_N]; // their covariance; both triangles
  float off_m;                 // the estimator's height minus h
  int off_steps;               // in the mean off_m
  float thrust_N;              // T
  float sent_N[3];             // the commands of the last steps
  float acc_mps2;              // a of the last step
  float acc_odd, down_odd;     // means of e^2 over its variance; 1 if all fits
  float down_last_m;
  int same, silent, wild; // samples alike; steps without one; samples rejected in a row
  int fit;                // steps since something did not fit, up to HEIGHT_TRUST times wait
  int wait;               // steps that the filter has to fit before it is flown
  float share;            // of this filter in what is flown
  float more_m, more_mps; // height and climb rate minus the estimator's
  bool started;
} height_t;

// What the law uses.
typedef struct {
  float more_m, more_mps; // height and climb rate minus the estimator's
  pos_indi_param_t law;   // with the gains that belong to them
} height_fly_t;

// Nothing is known: the estimator's height is flown.
static inline void height_init(height_t *s) {
  *s = (height_t){.wait = HEIGHT_FIT};
}

// Forgets the last steps; what is flown fades out. `wait` stays.
static inline void height_lose(height_t *s) {
  s->started = false;
  s->fit = 0;
}

// Runs one step. motor_share: thrust_lag_share(HEIGHT_S, tau_s). An input that is not finite, or beyond any
// flight, counts as a lost sensor.
void height_step(height_t *s, const height_param_t *p, float motor_share, const height_in_t *in);

// Computes *fly, HEIGHT_AHEAD_S after a step; the estimator gives z_m and climb_mps (finite) then.
void height_fly(height_t *s, const height_param_t *p, const pos_indi_param_t *law, float z_m, float climb_mps,
                height_fly_t *fly);

#endif
