// units.h - the border: the only place with g, degrees, PWM units and foreign signs; of ranges in millimetres
// see range_up.h and take_down() in controller.c.
//
//   firmware                                                  here
//   sensors acc g, gyro deg/s                                 m/s2, rad/s
//   attitudeQuaternion (x, y, z, w), right-handed             (w, x, y, z); state attitude has pitch inverted
//   set point attitude deg, pitch nose up positive            rad, right-handed: nose down positive
//   set point thrust 0..65535 of all motors alike             newton, all motors together
//   control_t: force per motor over THRUST_MAX, 0..1          newton
#ifndef FIRMWARE_UNITS_H
#define FIRMWARE_UNITS_H

#include "flight/flight.h"
#include "stabilizer_types.h"

// Converts sensors and estimate; all else of *in is kept.
void units_sensors(flight_in_t *in, const sensorData_t *sensors, const state_t *state);

// Converts a set point. What is not flown (units_not_flown) becomes level, at the thrust asked for: there is
// no rate controller.
void units_setpoint(flight_setpoint_t *to, const setpoint_t *setpoint);

// Returns NOT_FLOWN_*: roll or pitch by their rates; an attitude as quaternion while x or y is not
// controlled; the rates of roll and pitch in a full state.
unsigned units_not_flown(const setpoint_t *setpoint);

// Computes the force that the firmware's power distribution asks of each motor, in any of its three modes.
void units_applied(float force_N[MOTORS], const control_t *control);

// Commands in the firmware's force mode: ForceTorque would mix again and undo the mixer's order of giving up.
void units_command(control_t *control, const float force_N[MOTORS]);

#endif
