// stock_position.h - the position and velocity cascade of the Crazyflie's PID controller, 100 Hz.
//
//   wanted velocity = PID(position), within +-1.1 m/s;  roll, pitch = PID(velocity), within +-20 deg;
//   thrust = 1000 PID(climb) + 36000, within 20000..65535
//
// x and y are along the heading. In position mode the set point's velocity and acceleration are not used.
// Source: bitcraze/crazyflie-firmware 2a18fc29, position_controller_pid.c and platform_defaults*.h.
#ifndef SIM_CRAZYFLIE_STOCK_POSITION_H
#define SIM_CRAZYFLIE_STOCK_POSITION_H

#include "crazyflie/pid_block.h"
#include "crazyflie/stock_units.h"

typedef struct {
  pid_gain_t pos[3]; // x, y, z: m to m/s
  pid_gain_t vel[3]; // x, y: m/s to degrees; z: m/s to thrust_scale units
  double tilt_max_deg;
  double thrust_scale, thrust_base, thrust_min; // units
} stock_position_param_t;

stock_position_param_t stock_position_default(void);

typedef struct {
  pid_block_t pos[3], vel[3];
} stock_position_t;

typedef struct {
  double roll_deg, pitch_deg; // pitch nose up
  double thrust;              // units
} stock_position_out_t;

// Starts with all integrals 0 and all filters at rest.
void stock_position_start(stock_position_t *s, const stock_position_param_t *p, d3_t pos_w_m);

// Runs one period of 10 ms.
stock_position_out_t stock_position_step(stock_position_t *s, const stock_position_param_t *p,
                                         const pilot_in_t *in, double yaw_deg);

#endif
