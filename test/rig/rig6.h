// rig6.h - a small rigid body for tests of pilots: four lagging motors, explicit Runge-Kutta of order 4 at 1
// ms, perfect measurements. It shares nothing with the plant.
//
//   m v' = sum k f_i z_b - m g,  J w' = moments - w x J w,  f_i' = (u_i - f_i)/tau
//   yaw: ratio (-f1 + f2 - f3 + f4), and the rotors' inertia against their acceleration, speed = sqrt(f/kf)
#ifndef TEST_RIG_RIG6_H
#define TEST_RIG_RIG6_H

#include "crazyflie/pilot.h"

#define RIG6_TOUCH_M 0.005 // nearer to the ceiling the body cannot rise

typedef struct {
  double mass_kg;
  d3_t inertia_kgm2;
  double arm_m;      // distance of each motor along x and along y
  double torque_m;   // drag torque over thrust
  double rotor_kgm2; // inertia of one rotor; 0: none
  double speed_N;    // kf, N/(rad/s)^2
  double tau_s;      // lag of the motors
  double ceiling_m;  // height of the plate; NaN: none. Thrust ratio 1/2 + 1/2 sqrt(1 + (R/d)^2/8) per rotor
  double radius_m;   // R
  bool floor;        // at z = 0 the body cannot go down, nor turn while it stands
  d3_t acc_bias_b_mps2; // of the accelerometer
} rig6_param_t;

// 32.9 g, inertia of the Crazyflie 2.1, 57 ms, no rotor inertia, no surfaces.
rig6_param_t rig6_crazyflie(void);

typedef struct {
  rig6_param_t param;
  d3_t pos_w_m, vel_w_mps, rate_b_radps;
  dq_t q_wb;
  double force_N[PILOT_MOTORS];   // of the motors in free air
  double command_N[PILOT_MOTORS]; // as last given
  double vbat_V;
  uint32_t step;
} rig6_t;

// At rest at that place and heading. hovering: the motors carry its weight, else they stand still.
rig6_t rig6_at(const rig6_param_t *param, d3_t pos_w_m, double yaw_rad, bool hovering);

// Perfect measurements, with the set point.
pilot_in_t rig6_sense(const rig6_t *r, const pilot_setpoint_t *set);

// Moves it for one millisecond under the command.
void rig6_step(rig6_t *r, const double motor_N[PILOT_MOTORS]);

// Flies for so long; calls `watch`, unless null, after every step.
void rig6_fly(rig6_t *r, const pilot_t *pilot, const pilot_setpoint_t *set, double seconds,
              void (*watch)(const rig6_t *, void *), void *user);

double rig6_yaw_rad(const rig6_t *r);
double rig6_tilt_rad(const rig6_t *r);

// Set points: hold this place and heading; hold this velocity (world axes) and height.
pilot_setpoint_t rig6_hold(d3_t pos_w_m, double yaw_rad);
pilot_setpoint_t rig6_go(d3_t vel_w_mps, double z_m, double yaw_rad);

#endif
