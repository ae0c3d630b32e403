// units.h - the border: the only place where g, degrees, millimetres, PWM units and foreign signs are in
// sight.
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

// Sensors and estimate; all else of *in is kept.
void units_sensors(flight_in_t *in, const sensorData_t *sensors, const state_t *state);

// What is not flown (units_not_flown) is level, at the thrust that it asks for: there is no rate controller.
void units_setpoint(flight_setpoint_t *to, const setpoint_t *setpoint);

// NOT_FLOWN_*: roll and pitch by their rates; an attitude as quaternion where x and y are not controlled; the
// rates of roll and pitch that a full state brings along.
unsigned units_not_flown(const setpoint_t *setpoint);

// The force that the firmware's power distribution asks of each motor, in any of its three modes.
void units_applied(float force_N[MOTORS], const control_t *control);

// The firmware's own force mode: ForceTorque would mix again and undo what the mixer gave up first.
void units_command(control_t *control, const float force_N[MOTORS]);

#endif
