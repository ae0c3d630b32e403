// stock_indi.h - the peer: the Crazyflie firmware's own INDI (its controller number 3), with its faults.
//
//   rate_ref = 5 (angle_ref - angle),  nu = 24 (rate_ref - rate),  du = (nu - d rate_f/dt)/G1,  u = u_f + du
//   yaw: du = (nu - d rate_f/dt + G2 du_last)/(G1 + G2)
//
// Axes north-east-down, radians, 500 Hz. rate and u pass the same 8 Hz low-pass, u before it a lag of gain
// 0.03149 (62.5 ms). Position loop: stock_indi_outer.h. Source: bitcraze/crazyflie-firmware 2a18fc29,
// controller_indi.c.
//
// Faults of the firmware that are kept here, and that our controller must not have (test_flight.c):
//   1  with a yaw rate, the wanted yaw so far is converted from degrees to radians anew every tick: heading 0
//   2  the yaw error is not wrapped
//   3  a velocity set point in the body's frame is taken for one in the world's
//   4  with the position loop off (param.outer), the PID cascade's degrees are used as radians
//   5  the position loop integrates on the ground and is never reset
//   6  a bias of the accelerometer is a steady height error, 2 cm for 0.01 g
//   7  velocity and acceleration of a trajectory are dropped
//   8  cut-off parameters act only after the controller has been selected again
#ifndef SIM_CRAZYFLIE_STOCK_INDI_H
#define SIM_CRAZYFLIE_STOCK_INDI_H

#include "crazyflie/stock_indi_outer.h"
#include "crazyflie/stock_position.h"

typedef struct {
  stock_indi_outer_param_t position;
  stock_position_param_t cascade; // used if not `outer`
  bool outer;                     // the position loop is INDI; else the PID cascade
  double g1[3], g2;               // roll, pitch, yaw: rad/s2 per unit; g2 as used: per unit and tick
  double angle_per_s, rate_per_s; // gains
  double lag_gain;                // per tick of 2 ms
  double cutoff_Hz;               // read only when the controller is selected
  double thrust_min, command_max; // units: with less, the increments are cleared; largest command
  stock_power_param_t power;
} stock_indi_param_t;

// As shipped, with the legacy propellers.
stock_indi_param_t stock_indi_default(void);

typedef struct {
  stock_indi_param_t param; // may be changed in flight
  stock_indi_outer_t position;
  stock_position_t cascade;
  lowpass_t rate[3], u[3];
  double u_lagged[3], u_in[3], du_yaw; // units; pitch nose up, yaw clockwise
  double angle_rad[3];                 // wanted (degrees where fault 4 acts)
  double thrust;                       // units
  stock_command_t command;
  stock_power_t power;
} stock_indi_t;

// Does what the firmware does when the controller is selected, also in flight: filters and increments start
// at 0, the thrust of the position loop stays (fault 5). The pilot's reset() is a power-on: everything starts
// at 0.
void stock_indi_select(stock_indi_t *s);

// To be called every millisecond; s->command is the command to the mixer.
void stock_indi_step(stock_indi_t *s, const pilot_in_t *in, double motor_N[PILOT_MOTORS]);

pilot_t stock_indi_pilot(stock_indi_t *s, const stock_indi_param_t *param);

#endif
