// rigid.h - a rigid body with four rotors: 17 states.
//
//   p' = v                                 m v' = R (F + e3 sum rho_i f_i) - m g e3
//   q' = q (0, w) / 2                      f_i' = (command_i - f_i) / tau
//   J w' = M + sum(r_i x e3 rho_i f_i) - e3 sum s_i (c f_i + I_r Om_i') - w x (J w + e3 sum s_i I_r Om_i)
//   Om_i = sqrt(f_i / kf)
//
// p, v: of the centre of mass, in the world (z up). R, q: body to world. w: body rates. f_i: thrust of rotor
// i in free air, rho_i: what the surroundings multiply it by. c: torque over thrust, s_i: +1 where the rotor
// turns counter-clockwise seen from above (the body is turned the other way). F, M: all other forces and
// moments, in body axes about the centre of mass. The torque follows the thrust in free air, that is, the
// rotor's speed.
#ifndef SIM_PLANT_RIGID_H
#define SIM_PLANT_RIGID_H

#include "base/d3.h"
#include "plant/vertical.h"
#include <stdbool.h>

#define ROTORS 4

// Order of the state in y[RIGID_N].
enum {
  RIGID_POS_M,
  RIGID_VEL_MPS = 3,
  RIGID_Q_WB = 6,
  RIGID_RATE_RADPS = 10,
  RIGID_THRUST_N = 13,
  RIGID_N = 17
};

// Slower than this a rotor is taken to turn at this speed: its acceleration at a given change of thrust is
// infinite at rest. A tenth of a Crazyflie's speed at hover.
#define ROTOR_SLOWEST_RADPS 200.0

typedef struct {
  double mass_kg;    // > 0
  d3_t inertia_kgm2; // > 0, about the body's axes
  double rotor_x_m[ROTORS], rotor_y_m[ROTORS],
      rotor_z_m[ROTORS];       // centres, from the centre of mass, body axes
  double spin[ROTORS];         // +1 counter-clockwise seen from above, -1 clockwise
  double torque_ratio_m;       // >= 0   torque over thrust of a rotor
  double kf_Ns2;               // > 0    thrust over speed squared, N/(rad/s)^2
  double rotor_inertia_kgm2;   // >= 0   of propeller and motor about the axis
  double motor_tau_s;          // > 0
  double thrust_scale[ROTORS]; // 1: healthy. What the thrust is multiplied by, apart from surroundings
  double torque_scale[ROTORS]; // what the torque is multiplied by besides
  double command_N[ROTORS];    // held
  double per_mass, per_tau, per_root_kf, half_I_per_kf; // set by rigid_tune
  d3_t per_inertia;                                     // set by rigid_tune
  bool vertical_only;                                   // all but height, climb and thrust stand still
  bool held;                                            // all but the thrust stands still
} rigid_t;

// Force and moment about the centre of mass, body axes.
typedef struct {
  d3_t force_b_N, moment_b_Nm;
} load_t;

static inline void load_add(load_t *load, d3_t force_b_N, d3_t moment_b_Nm) {
  load->force_b_N = d3_add(load->force_b_N, force_b_N);
  load->moment_b_Nm = d3_add(load->moment_b_Nm, moment_b_Nm);
}

// Computes what the derivative needs of mass, inertias, lag and kf; whenever one of them has changed.
void rigid_tune(rigid_t *r);

// Brings the quaternion back to unit length.
void rigid_normalise(double y[RIGID_N]);

// Kinetic energy of translation and rotation (J), without the rotors' own.
double rigid_energy_J(const rigid_t *r, const double y[RIGID_N]);

// Angular momentum about the centre of mass with the rotors' own, world axes.
d3_t rigid_momentum_w(const rigid_t *r, const double y[RIGID_N]);

#endif
