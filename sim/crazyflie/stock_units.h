// stock_units.h - conversion between SI and the units of the Crazyflie's firmware, for its controllers as
// peers.
//
// The firmware's units: degrees, degrees per second, g, and 16-bit commands, of which 65535 is thrust_max_N
// per motor. Roll is positive to the right, pitch nose UP, yaw counter-clockwise; the yaw command is positive
// CLOCKWISE.
// Sources, bitcraze/crazyflie-firmware 2a18fc29: stabilizer.c, power_distribution_quadrotor.c, motors.c,
// platform_defaults_cf2.h.
#ifndef SIM_CRAZYFLIE_STOCK_UNITS_H
#define SIM_CRAZYFLIE_STOCK_UNITS_H

#include "crazyflie/pilot.h"

#define STOCK_FULL          65535.0 // full scale of a 16-bit command
#define STOCK_ATTITUDE_HZ   500.0
#define STOCK_POSITION_HZ   100.0
#define STOCK_ATTITUDE_STEP 2u  // calls of 1 ms
#define STOCK_POSITION_STEP 10u // calls of 1 ms
#define STOCK_DEG           57.29577951308232

// The vehicle as the firmware's controllers see it.
typedef struct {
  d3_t gyro_dps;                       // body, x forward, y left, z up
  d3_t acc_g;                          // body
  double roll_deg, pitch_deg, yaw_deg; // -180..180, -90..90, -180..180
} stock_view_t;

stock_view_t stock_view(const pilot_in_t *in);

// The angles alone, in the same ranges.
typedef struct {
  double roll_deg, pitch_deg, yaw_deg;
} stock_angles_t;

stock_angles_t stock_angles(dq_t q_wb);

// Wraps an angle into -180..180.
double stock_cap_deg(double angle_deg);

// A command to the mixer, in units of one motor.
typedef struct {
  double thrust;           // 0..65535
  double roll, pitch, yaw; // -32767..32767; the integer part counts
} stock_command_t;

typedef struct {
  double volt_cubic[4];              // N of one motor = c0 + c1 v + c2 v^2 + c3 v^3, v: volts at the motor
  double thrust_min_N, thrust_max_N; // of one motor: below the first it is off; the second is 65535
  double volt_quadratic[2]; // volts = q0 g + q1 g^2, g: grams of four such motors; q0 0: the cubic's root
} stock_power_param_t;

// Legacy propellers of the Crazyflie 2.1, and the present ones (2.1+).
stock_power_param_t stock_power_legacy(void);
stock_power_param_t stock_power_plus(void);
// Legacy propellers with firmware until mid-2025: full scale was 60 g for all motors, which makes the same
// gains 1.23 times as strong.
stock_power_param_t stock_power_60g(void);
// The same with the firmware's voltage of 2022, 0.088 g - 0.0006239 g^2. With the cubic's propellers 36000
// units, 33.0 g, then give 26.3 g: the PID's base thrust does not lift the vehicle, its integrals must.
stock_power_param_t stock_power_2022(void);

typedef struct {
  double supply_V; // battery voltage, low-passed at 1 kHz with a gain of 0.01
  double wanted_N[PILOT_MOTORS],
      wanted_V[PILOT_MOTORS]; // of the last call, so that the cubic is solved only where a thrust has changed
} stock_power_t;

void stock_power_start(stock_power_t *s);

// Computes the units of each motor for a command: roll and pitch are halved, all numbers are truncated to
// whole ones, nothing is limited.
void stock_mix(const stock_command_t *command, double unit[PILOT_MOTORS]);

// Computes the duty 0..65535 of each motor from its units (truncated to whole ones): the volts come from the
// cubic, the duty from the filtered battery voltage. If a duty is above 65535, all four are lowered by the
// same amount and those below 0 stay at 0: thrust is given up before attitude. A motor below thrust_min_N is
// off, and below 2 V of battery all are. To be called every millisecond.
void stock_power_duty(stock_power_t *s, const stock_power_param_t *p, const double unit[PILOT_MOTORS],
                      double vbat_V, double duty[PILOT_MOTORS]);

// The same, and motor_N: the thrust of the cubic's propellers at this duty, N.
void stock_power_step(stock_power_t *s, const stock_power_param_t *p, const double unit[PILOT_MOTORS],
                      double vbat_V, double motor_N[PILOT_MOTORS]);

#endif
