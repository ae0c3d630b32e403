// inflow.h - a rotor whose inflow a surface hinders: its thrust, speed, torque and current at a constant
// command. Header only.
//
// All are ratios to free air at the same duty and voltage: thrust rho (a published curve of a ceiling or of
// the ground), speed s, torque q, and current q as well, because a motor's torque is proportional to its
// current. i: inflow angle of the blades.
//
//   motor   q = 1 - M/2 (s^2 - 1)             torque over speed at constant voltage, to first order
//   blades  rho = s^2 (1 + B (1 - i))         blade element theory: lift falls with the inflow
//   power   q = (1 - P) s^2 + P rho i         profile, and thrust times inflow (momentum theory), over s
//
// Without q and i this is a quadratic equation in w = s^2:
//
//   (1 - P + M/2) w^2 - (1 + M/2 - P (1 + 1/B) rho) w - P rho^2 / B = 0
//
// Under a ceiling s > 1 and q < 1: the rotor turns faster and draws less, as Hsiao and Chirarattananon 2019
// (arXiv 1905.04632) derive and measure. At constant thrust it needs a third of the power at contact, as do
// their rotors of 23 mm radius. Under the thesis's ceiling, at the same command, it turns 0.5 % faster at 2
// cm and 3.8 % faster at contact, with 0.7 and 5.4 % less torque. The torque of the rotor's inertia while a
// surface comes nearer is neglected: at 0.1 m/s the speed changes by 0.1 rad/s in 1 ms.
#ifndef SIM_PLANT_INFLOW_H
#define SIM_PLANT_INFLOW_H

#include "base/few.h"

// M: a motor's induced voltage over its resistive voltage drop, at hover. For a Crazyflie's motor of 14,000
// rpm/V: 1.4 V at 2,000 rad/s, of 2.4 V.
#define INFLOW_MOTOR 1.4
// P: share of the power in free air that the inflow takes: a figure of merit of 0.3 from torque and thrust
// over speed (vehicles/cf21_legacy.toml), times 1.15 for an uneven inflow.
#define INFLOW_POWER 0.35
// B: relative gain in thrust at a given speed if there were no inflow. Assumed: blades at 20 deg from zero
// lift, inflow 0.093 of the tip speed: (0.093 / 2) / (0.35 / 3 - 0.093 / 2).
#define INFLOW_BLADES 0.66

// s of the rotors. rho > 0; faster: the share by which they turn faster for other reasons.
FEW_INLINE few_t inflow_turning(few_t rho, few_t faster) {
  const double a = 1.0 - INFLOW_POWER + 0.5 * INFLOW_MOTOR, c = INFLOW_POWER / INFLOW_BLADES;
  const few_t b = 1.0 + 0.5 * INFLOW_MOTOR - (INFLOW_POWER + c) * rho;
  return few_sqrt((b + few_sqrt(b * b + 4.0 * a * c * rho * rho)) * (0.5 / a)) + faster;
}

// q of the rotors, >= 0: a motor that the air drives gives nothing back.
FEW_INLINE few_t inflow_torque(few_t turning) {
  return few_max(1.0 - 0.5 * INFLOW_MOTOR * (turning * turning - 1.0), few_all(0.0));
}

#endif
