// air_garage.h - the peer: the air garage's thrust division (XinLong-Li/cf-frimware-2022-12) around the stock
// PID.
//
//   ceiling ratio  1/2 + 1/2 sqrt(1 + (R/d)^2/8)   2.337 at 0.1 R, 1.37 at 0.25 R, 1.11 at 0.5 R
//   ground ratio   1/(1 - (R/(4 h))^2)             1.33 at 0.5 R, 1.07 at R
//
// d: from the position to the ceiling, h: from the ground to the position.
//
// AIR_GARAGE_TOTAL (7f30196b, September 2024): the thrust command is divided by both ratios at the position;
// nearer than 0.5 R the ceiling ratio is 1.11 and the ground ratio 2. AIR_GARAGE_PER_ROTOR (a8e033f8, June
// 2025): each motor's command, torques included, is divided by the square root of the product of both ratios
// at that rotor, without limits near a surface. Its table of rotor positions is one arm off from its mixer
// (m1 is ahead left in the table, and ahead right in the mixer), so that a tilt is corrected at the wrong
// rotors; this is kept, see left_m and ahead_m.
//
// Both measure distances from the position, not from the propellers. The heights of ceiling and ground are
// given; no range sensor is used. Every motor's command is limited to 0..65535. Left out is the rectangle in
// x and y outside of which both ratios are 1. The PID is the stock one of 2022, when full scale was 60 g
// (stock_power_60g).
#ifndef SIM_PILOTS_AIR_GARAGE_H
#define SIM_PILOTS_AIR_GARAGE_H

#include "crazyflie/stock_pid.h"

typedef enum { AIR_GARAGE_TOTAL, AIR_GARAGE_PER_ROTOR } air_garage_how_t;

typedef struct {
  stock_pid_param_t pid;
  air_garage_how_t how;
  double ceiling_m, ground_m;   // heights, world; HUGE_VAL and -HUGE_VAL: none
  double radius_m;              // R
  double ahead_m[4], left_m[4]; // of the rotors, AIR_GARAGE_PER_ROTOR
  double near_R;                // up to this distance (in R) the ratios are the next two; 0: never
  double near_ceiling, near_ground;
} air_garage_param_t;

// Without ceiling and ground, which the caller sets.
air_garage_param_t air_garage_2024(void);
air_garage_param_t air_garage_2025(void);

// The ratios at a distance in metres. Where the ground formula does not hold (h <= R/4), the result is
// negative or infinite, as in the firmware; motors whose command is divided by it stop.
double air_garage_ceiling_ratio(const air_garage_param_t *p, double distance_m);
double air_garage_ground_ratio(const air_garage_param_t *p, double distance_m);

typedef struct {
  air_garage_param_t param;
  stock_pid_t pid;
} air_garage_t;

pilot_t air_garage_pilot(air_garage_t *s, const air_garage_param_t *param);

#endif
