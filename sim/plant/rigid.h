// rigid.h - a rigid body with four rotors: 17 states.
//
//   p' = v                                 m v' = R (F + e3 sum rho_i f_i) - m g e3
//   q' = q (0, w) / 2                      f_i' = (command_i - f_i) / tau   lag in thrust
//                                          Om_i' = (Om(command_i) - Om_i) / tau   lag in speed: f_i' = 2 kf
//                                          Om_i Om_i'
//   J w' = M + sum(r_i x e3 rho_i f_i) - e3 sum d_i (c q_i f_i + I_r Om_i') - w x (J w + e3 sum d_i I_r Om_i)
//   Om_i = s_i sqrt(f_i / kf)
//
// p, v: position and velocity of the centre of mass, world axes (z up). R, q: body to world. w: body rates.
// f_i: thrust of rotor i in free air, rho_i: its factor due to the surroundings. c: torque over thrust, d_i:
// +1 if the rotor turns counter-clockwise seen from above (its torque turns the body the other way). F, M:
// all other forces and moments, in body axes about the centre of mass. s_i, q_i: factors of a rotor's speed
// and torque where surroundings hinder its inflow (plant/inflow.h); 1 in free air, where the torque is
// proportional to the thrust. The lag is that of free air.
#ifndef SIM_PLANT_RIGID_H
#define SIM_PLANT_RIGID_H

#include "base/constants.h"
#include "base/d3.h"
#include "base/few.h"
#include "plant/inflow.h"
#include "plant/lag.h"
#include <stdbool.h>

#define ROTORS 4

// Indices of the state in y[RIGID_N].
enum {
  RIGID_POS_M,
  RIGID_VEL_MPS = 3,
  RIGID_Q_WB = 6,
  RIGID_RATE_RADPS = 10,
  RIGID_THRUST_N = 13,
  RIGID_N = 17
};

// A slower rotor is taken to turn at this speed, because at rest its acceleration for a given change of
// thrust is infinite. A tenth of a Crazyflie's speed at hover.
#define ROTOR_SLOWEST_RADPS 200.0

typedef struct {
  double mass_kg;    // > 0
  d3_t inertia_kgm2; // > 0, about the body's axes
  double rotor_x_m[ROTORS], rotor_y_m[ROTORS],
      rotor_z_m[ROTORS];                 // centres, from the centre of mass, body axes
  double spin[ROTORS];                   // +1 counter-clockwise seen from above, -1 clockwise
  double torque_ratio_m;                 // >= 0   torque over thrust of a rotor
  double kf_Ns2;                         // > 0    thrust over speed squared, N/(rad/s)^2
  double rotor_inertia_kgm2;             // >= 0   of propeller and motor about the axis
  double motor_tau_s;                    // >= 0   below LAG_LEAST_S there is no lag: thrust is as commanded
  double motor_down_over_up;             // >= 0   factor of the lag while the thrust falls; 0: 1
  double lag_up_square, lag_down_square; // 0 to 1, see plant/lag.h
  double lag_steady_N;                   // > 0
  double thrust_scale[ROTORS];           // factor of the thrust, apart from surroundings; 1: healthy
  double torque_scale[ROTORS];           // further factor of the torque
  double faster[ROTORS];                 // share by which it turns faster, apart from its inflow
  double per_mass, per_tau, per_tau_down, per_root_kf, half_I_per_kf, per_two_steady; // set by rigid_tune
  d3_t per_inertia;                                                                   // set by rigid_tune
  double command_N[ROTORS]; // constant during a tick
  bool lag_in_speed;        // else in thrust
  bool plain_lag;           // set by rigid_tune: the lag is in thrust, and the same up and down
  bool vertical_only;       // all but height, climb and thrust stand still
  bool held;                // all but the thrust stands still
} rigid_t;

// Force and moment about the centre of mass, body axes.
typedef struct {
  d3_t force_b_N, moment_b_Nm;
} load_t;

static inline void load_add(load_t *load, d3_t force_b_N, d3_t moment_b_Nm) {
  load->force_b_N = d3_add(load->force_b_N, force_b_N);
  load->moment_b_Nm = d3_add(load->moment_b_Nm, moment_b_Nm);
}

// Computes what the derivative needs from mass, inertias, lag and kf. Call it whenever one of them has
// changed.
void rigid_tune(rigid_t *r);

lag_t rigid_lag(const rigid_t *r);

// Scales the quaternion to unit length.
void rigid_normalise(double y[RIGID_N]);

// Kinetic energy of translation and rotation (J), without that of the rotors.
double rigid_energy_J(const rigid_t *r, const double y[RIGID_N]);

// --- the equations: inline, because nearly all of a flight's time is spent here --------------------------

// Speeds of the rotors in free air, rad/s, >= ROTOR_SLOWEST_RADPS. f: their thrusts in free air, N.
static inline void rigid_rotor_radps(const rigid_t *r, const double f[ROTORS], double speed[ROTORS]) {
  const few_t zero = few_all(0.0), slowest = few_all(ROTOR_SLOWEST_RADPS);
  for (int i = 0; i < ROTORS; i += FEW_N)
    few_put(speed + i, few_max(few_sqrt(few_max(few_of(f + i), zero)) * r->per_root_kf, slowest));
}

// Rate of change of the rotors' thrusts. A rotor at rest starts as if it turned at ROTOR_SLOWEST_RADPS.
FEW_INLINE few_t rigid_change_Nps(const rigid_t *r, few_t thrust, few_t command, few_t speed) {
  if (r->plain_lag) return (command - thrust) * r->per_tau;
  const few_t zero = few_all(0.0);
  few_t up = command - thrust, down = up;
  if (r->lag_in_speed) {
    const few_t to = few_sqrt(few_max(command, zero)) * r->per_root_kf,
                from = few_sqrt(few_max(thrust, zero)) * r->per_root_kf,
                off = 2.0 * r->kf_Ns2 * speed * (to - from), faster = (to + from) * r->per_two_steady - 1.0;
    up = off * (1.0 + r->lag_up_square * faster);
    down = off * (1.0 + r->lag_down_square * faster);
  }
  return few_max(up, zero) * r->per_tau + few_min(down, zero) * r->per_tau_down;
}

// Sum of the rotors' thrusts, and the moment of their thrusts, torques and inertias.
typedef struct {
  double thrust_N;
  d3_t moment_b_Nm;
  double spin_Nms; // angular momentum of the rotors along z
} rotors_t;

static inline rotors_t rigid_rotors(const rigid_t *r, const double *f, const double *speed,
                                    const double *ratio, const double *turning, double *df) {
  few_t lift = few_all(0.0), roll = lift, pitch = lift, yaw = lift, spin = lift;
  for (int i = 0; i < ROTORS; i += FEW_N) {
    const few_t thrust = few_of(f + i), scaled = few_of(r->thrust_scale + i) * thrust,
                up = few_of(ratio + i) * scaled, om = few_of(speed + i), turns = few_of(r->spin + i),
                change = rigid_change_Nps(r, thrust, few_of(r->command_N + i), om), s = few_of(turning + i);
    few_put(df + i, change);
    lift += up;
    roll += few_of(r->rotor_y_m + i) * up;
    pitch -= few_of(r->rotor_x_m + i) * up;
    yaw -= turns * (r->torque_ratio_m * few_of(r->torque_scale + i) * inflow_torque(s) * scaled +
                    r->half_I_per_kf * s * change / om);
    spin += turns * s * om;
  }
  return (rotors_t){
      few_sum(lift), {few_sum(roll), few_sum(pitch), few_sum(yaw)}, r->rotor_inertia_kgm2 * few_sum(spin)};
}

// Derivative of all states but the thrusts, stored in fours, as the integrator then loads it.
static inline void rigid_move(const rigid_t *r, const double *y, const axes_t *axes, d3_t force_b_N,
                              d3_t moment_b_Nm, double spin_Nms, double *dydt) {
  const d3_t acc = d3_scale(r->per_mass, axes_to_world(axes, force_b_N));
  const d3_t w = d3_of(y + RIGID_RATE_RADPS), J = r->inertia_kgm2, per = r->per_inertia;
  const d3_t h = d3(J.x * w.x, J.y * w.y, J.z * w.z + spin_Nms);
  const d3_t left = d3_sub(moment_b_Nm, d3_cross(w, h));
  const double a = y[RIGID_Q_WB], b = y[RIGID_Q_WB + 1], c = y[RIGID_Q_WB + 2], d = y[RIGID_Q_WB + 3];
  few_put_four(dydt, y[RIGID_VEL_MPS], y[RIGID_VEL_MPS + 1], y[RIGID_VEL_MPS + 2], acc.x);
  few_put_four(dydt + RIGID_VEL_MPS + 1, acc.y, acc.z - G_MPS2, -0.5 * (b * w.x + c * w.y + d * w.z),
               0.5 * (a * w.x + c * w.z - d * w.y));
  few_put_four(dydt + RIGID_Q_WB + 2, 0.5 * (a * w.y + d * w.x - b * w.z),
               0.5 * (a * w.z + b * w.y - c * w.x), left.x * per.x, left.y * per.y);
  dydt[RIGID_RATE_RADPS + 2] = left.z * per.z;
}

// speed: of the rotors in free air, from rigid_rotor_radps. axes: axes_of(the state's quaternion). ratio: rho
// of each rotor. turning: s of each rotor. load: everything except the rotors' thrusts, torques and inertias;
// null: nothing.
static inline void rigid_derivative(const rigid_t *r, const double y[RIGID_N], const axes_t *axes,
                                    const double speed[ROTORS], const double ratio[ROTORS],
                                    const double turning[ROTORS], const load_t *load, double dydt[RIGID_N]) {
  const rotors_t all = rigid_rotors(r, y + RIGID_THRUST_N, speed, ratio, turning, dydt + RIGID_THRUST_N);
  d3_t force_b_N = {0.0, 0.0, all.thrust_N}, moment_b_Nm = all.moment_b_Nm;
  if (load) {
    force_b_N = d3_add(load->force_b_N, force_b_N);
    moment_b_Nm = d3_add(load->moment_b_Nm, moment_b_Nm);
  }
  rigid_move(r, y, axes, force_b_N, moment_b_Nm, all.spin_Nms, dydt);
  if (!r->vertical_only && !r->held) return;
  for (int i = 0; i < RIGID_THRUST_N; i++)
    if (r->held || (i != RIGID_POS_M + 2 && i != RIGID_VEL_MPS + 2)) dydt[i] = 0.0;
}

#endif
