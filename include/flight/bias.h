// bias.h - the accelerometer's bias, from the position as estimated, and the velocity without its share of
// it.
//
// An incremental law holds the measured acceleration, so that a bias b of the accelerometer becomes a
// standing error of -b/(kp kd), 2 cm for 0.01 g with the thesis's gains, and the estimator's velocity, fed by
// the same accelerometer, adds to it (thesis C.3). Per axis, with the position p as the measurement and three
// poles at -w:
//
//   p' = v + 3 w e,   v' = a - b + 3 w^2 e,   b' = -w^3 e,   e = measured - p
//
// Only the bias is used of this: its velocity is noisier than the estimator's. That one is held against the
// change of the position, over vel_s = T: it is wrong by
//
//   <v> - (p - <p>) / T,   <x>' = (x - <x>) / T
//
// (0.153 s x bias behind the firmware's Kalman filter, measured on sim/estimator; 0 where only the
// controller's accelerometer is wrong).
#ifndef FLIGHT_BIAS_H
#define FLIGHT_BIAS_H

#include "flight/v3.h"

typedef struct {
  float pole_radps; // 0: the bias is taken to be 0 and the velocity as it comes; else > 0
  float max_mps2;   // bound of the bias
  float vel_s;      // >= 0   time over which velocity and position are compared; 0: not
} bias_param_t;

typedef struct {
  v3_t pos_m, vel_mps, bias_mps2;
  v3_t pos_slow_m, vel_slow_mps, vel_off_mps; // means over vel_s, and what the velocity is wrong by
  bool compared;
} bias_t;

// No bias known; position and velocity as given.
void bias_start(bias_t *s, v3_t pos_m, v3_t vel_mps);

// One period. acc_mps2: measured, without gravity.
void bias_step(bias_t *s, const bias_param_t *p, v3_t acc_mps2, v3_t pos_m, v3_t vel_mps, float period_s);

// The estimator's velocity without what it is wrong by.
v3_t bias_free_velocity(const bias_t *s, v3_t vel_mps);

// A known jump of the position's origin, which is no motion.
void bias_shift(bias_t *s, v3_t by_m);

#endif
