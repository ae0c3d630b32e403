// stock_pid.h - the peer: the Crazyflie firmware's cascaded PID controller (its number 1) with its mixer.
//
//   position, velocity (100 Hz, stock_position.h) -> attitude (500 Hz) -> rate (500 Hz) -> mixer
//   (stock_units.h)
//
// A set point that changes a mode restarts the position PIDs with their filters and clears the integrals of
// attitude and rate; so does every tick with a thrust of exactly 0. A yaw rate moves the wanted heading
// without limit. Source: bitcraze/crazyflie-firmware 2a18fc29, controller_pid.c, attitude_pid_controller.c,
// platform_defaults*.h. Here it runs in double precision.
#ifndef SIM_CRAZYFLIE_STOCK_PID_H
#define SIM_CRAZYFLIE_STOCK_PID_H

#include "crazyflie/stock_position.h"

typedef struct {
  stock_position_param_t position;
  pid_gain_t attitude[3]; // roll, pitch, yaw: degrees to degrees per second
  pid_gain_t rate[3];     // degrees per second to units
  stock_power_param_t power;
} stock_pid_param_t;

// As shipped for the Crazyflie 2.x, with the legacy propellers.
stock_pid_param_t stock_pid_default(void);

typedef struct {
  stock_pid_param_t param;
  stock_position_t position;
  pid_block_t attitude[3], rate[3];
  stock_position_out_t wanted; // roll, pitch, thrust
  double yaw_deg;              // wanted
  double rate_dps[3];          // wanted: roll, pitch, yaw
  d3_t gyro_dps;               // body axes, at the last attitude step: for the firmware's logs
  double acc_z_g;              // likewise
  pilot_setpoint_t last;       // set point of the last call, for its modes
  stock_command_t command;
  stock_power_t power;
} stock_pid_t;

// stock_pid_command is all but the mixer, for peers that put something between the two. To be called every
// millisecond.
void stock_pid_reset(stock_pid_t *s);
const stock_command_t *stock_pid_command(stock_pid_t *s, const pilot_in_t *in);

pilot_t stock_pid_pilot(stock_pid_t *s, const stock_pid_param_t *param);

#endif
