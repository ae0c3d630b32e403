// mixer.h - torques and thrust to four motor forces: roll and pitch before thrust before yaw.
//
// Motors in the Crazyflie's order: 1 front right, 2 back right, 3 back left, 4 front left; 2 and 4 give
// positive yaw.
//
//   f = T/4 + (-roll, -roll, roll, roll)/(4 arm)
//           + (-pitch, pitch, pitch, -pitch)/(4 arm)
//           + (-yaw, yaw, -yaw, yaw)/(4 k)
//
// If the motors cannot give all of it, the mixer gives up yaw first, then thrust, and last roll and pitch
// together: a vehicle that is too heavy then sinks, but stays upright (the thesis's first flights crashed for
// want of this, C.1).
#ifndef FLIGHT_MIXER_H
#define FLIGHT_MIXER_H

#include "flight/status.h"
#include "flight/v3.h"

#define MOTORS 4

typedef struct {
  float arm_m;       // > 0   distance of a motor from the x axis, and from the y axis
  float yaw_m;       // > 0   torque over thrust of a rotor
  float force_max_N; // > 0 of one motor
} mixer_param_t;

typedef struct {
  float force_N[MOTORS]; // 0..force_max_N each
  v3_t torque_b_Nm;      // what these forces give
  float thrust_N;
  bool gave_up_yaw, gave_up_thrust, gave_up_tilt; // not fully given
} mixer_out_t;

// Mixes any torque and thrust; the result is always within the limits. A torque of NaN counts as 0, a thrust
// of NaN as the least that the torque allows.
mixer_out_t mixer_mix(const mixer_param_t *p, v3_t torque_b_Nm, float thrust_N);

// Returns the torque that four forces give. The signs are written out, roll - - + +, pitch - + + -,
// yaw - + - +: loops over tables of them take twice the instructions.
static ALWAYS_INLINE v3_t mixer_torque(const mixer_param_t *p, const float force_N[MOTORS]) {
  const float f0 = force_N[0], f1 = force_N[1], f2 = force_N[2], f3 = force_N[3];
  const float a0 = p->arm_m * f0, a1 = p->arm_m * f1, a2 = p->arm_m * f2, a3 = p->arm_m * f3;
  return (v3_t){-a0 - a1 + a2 + a3, a1 - a0 + a2 - a3,
                p->yaw_m * f1 - p->yaw_m * f0 - p->yaw_m * f2 + p->yaw_m * f3};
}

static ALWAYS_INLINE float mixer_thrust_N(const float force_N[MOTORS]) {
  return force_N[0] + force_N[1] + force_N[2] + force_N[3];
}

// Returns the torque and thrust that four forces give, with the forces.
mixer_out_t mixer_of(const mixer_param_t *p, const float force_N[MOTORS]);

#endif
