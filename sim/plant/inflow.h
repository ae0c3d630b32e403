// inflow.h - a rotor whose inflow a surface hinders: its thrust, speed, torque and current, at a command that
// stays. Header only.
//
// Over those in free air at the same duty and voltage: thrust rho (the published curve of a ceiling or of the
// ground is this), speed s, torque q, and current q, for a motor's torque is its current. i: inflow angle of
// the blades.
//
//   motor   q = 1 - M/2 (s^2 - 1)             its line at a constant voltage; M of it to first order
//   blades  rho = s^2 (1 + B (1 - i))         blade element: lift falls with the inflow
//   power   q = (1 - P) s^2 + P rho i         profile, and thrust times inflow: momentum; both over s
//
// Without q and i it is a quadratic equation in w = s^2:
//
//   (1 - P + M/2) w^2 - (1 + M/2 - P (1 + 1/B) rho) w - P rho^2 / B = 0
//
// s > 1 and q < 1 under a ceiling: it turns faster and draws less, as Hsiao and Chirarattananon 2019 (arXiv
// 1905.04632) derive and measure; at a thrust that stays it needs a third of the power at contact, as theirs
// of 23 mm radius do. Under the thesis's ceiling, at 2 cm and at contact: 0.5 and 3.8 % faster, 0.7 and 5.4 %
// less torque, at the same command. The inertia's torque while a surface comes nearer is left out: at 0.1 m/s
// the speed changes by 0.1 rad/s in 1 ms.
#ifndef SIM_PLANT_INFLOW_H
#define SIM_PLANT_INFLOW_H

#include "base/few.h"

// M: what a motor's turning induces over what its current loses, at hover. A Crazyflie's, 14,000 rpm/V: 1.4 V
// at 2,000 rad/s, of 2.4 V.
#define INFLOW_MOTOR 1.4
// P: share of the power in free air that goes with the inflow. Figure of merit 0.3 of torque and thrust over
// speed (vehicles/cf21_legacy.toml), by 1.15 for an inflow that is not even.
#define INFLOW_POWER 0.35
// B: by how much the thrust at a given speed would grow without inflow. Assumed: blades at 20 deg from where
// they have no lift, inflow 0.093 of the tip's speed: (0.093 / 2) / (0.35 / 3 - 0.093 / 2).
#define INFLOW_BLADES 0.66

// s of the rotors. rho > 0; faster: by what share they turn faster besides.
FEW_INLINE few_t inflow_turning(few_t rho, few_t faster) {
  const double a = 1.0 - INFLOW_POWER + 0.5 * INFLOW_MOTOR, c = INFLOW_POWER / INFLOW_BLADES;
  const few_t b = 1.0 + 0.5 * INFLOW_MOTOR - (INFLOW_POWER + c) * rho;
  return few_sqrt((b + few_sqrt(b * b + 4.0 * a * c * rho * rho)) * (0.5 / a)) + faster;
}

// q of them; a motor that is driven by the air gives nothing back.
FEW_INLINE few_t inflow_torque(few_t turning) {
  return few_max(1.0 - 0.5 * INFLOW_MOTOR * (turning * turning - 1.0), few_all(0.0));
}

#endif
