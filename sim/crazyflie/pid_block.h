// pid_block.h - one PID of the Crazyflie's firmware (its cascades are made of twelve).
//
//   u = clip(kp e + ki clip(int e) + kd (-d measured/dt through a second-order low-pass))
//
// The derivative is of the measurement, so that a step of the set point does not kick. All feed-forward gains
// of the firmware are 0 and are left out. Source: bitcraze/crazyflie-firmware 2a18fc29, pid.c.
#ifndef SIM_CRAZYFLIE_PID_BLOCK_H
#define SIM_CRAZYFLIE_PID_BLOCK_H

#include "base/lowpass.h"
#include <stdbool.h>

typedef struct {
  double kp, ki, kd;
  double integral_max; // of int e, in the unit of e times seconds
  double output_max;   // 0: none
  double cutoff_Hz;    // of the derivative; 0: none
} pid_gain_t;

typedef struct {
  lowpass_t slope;
  double integral, measured_last;
} pid_block_t;

#define PID_BLOCK_INTEGRAL_MAX 5000.0 // where the firmware names no limit

// Starts with integral 0, derivative filter at rest and the last measurement as given.
void pid_block_start(pid_block_t *s, const pid_gain_t *p, double rate_Hz, double measured);

// Sets the integral to 0 and the last measurement as given; the derivative filter goes on.
void pid_block_reset(pid_block_t *s, double measured);

// Runs one period. degrees: wanted and measured are angles of -180..180; the error is taken the short way.
double pid_block_step(pid_block_t *s, const pid_gain_t *p, double rate_Hz, double wanted, double measured,
                      bool degrees);

#endif
