// air_garage.h - the peer: the air garage's thrust division (XinLong-Li/cf-frimware-2022-12) around the stock
// PID.
//
//   ceiling ratio  1/2 + 1/2 sqrt(1 + (R/d)^2/8)   0.1 R 2.337, 0.25 R 1.37, 0.5 R 1.11
//   ground ratio   1/(1 - (R/(4 h))^2)             0.5 R 1.33, R 1.07
//
// d: position to ceiling, h: ground to position.
//
// AIR_GARAGE_TOTAL (7f30196b, September 2024): the thrust command is divided by both ratios at the position;
// nearer than 0.5 R the ceiling ratio is 1.11 and the ground ratio 2. AIR_GARAGE_PER_ROTOR (a8e033f8, June
// 2025): each motor's command, torques included, is divided by the root of both ratios at that rotor; no
// limits near by. In its table of places the rotors are one arm further round than its mixer has them (m1 is
// ahead left there, and ahead right in the mixer), so that a tilt is corrected at the wrong rotors; kept, see
// `left` and `ahead`.
//
// Both count distances from the position, not from the propellers; heights are known beforehand, no range
// sensor is used. Every motor's command is limited to 0..65535. Left out: the rectangle in x and y outside of
// which both ratios are 1. Its PID is the stock one of 2022, when full scale was 60 g (stock_power_60g).
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
  double near_R;                // nearer than this (in R) the ratios are these; 0: never
  double near_ceiling, near_ground;
} air_garage_param_t;

// Without ceiling and ground, which the caller knows.
air_garage_param_t air_garage_2024(void);
air_garage_param_t air_garage_2025(void);

// At a distance in metres. Where the ground form has no value (h <= R/4), the firmware's number is negative
// or infinite, and so is this; the motors that are divided by it stop.
double air_garage_ceiling_ratio(const air_garage_param_t *p, double distance_m);
double air_garage_ground_ratio(const air_garage_param_t *p, double distance_m);

typedef struct {
  air_garage_param_t param;
  stock_pid_t pid;
} air_garage_t;

pilot_t air_garage_pilot(air_garage_t *s, const air_garage_param_t *param);

#endif
