// bound.h - the least height error that any linear controller could have below a ceiling whose height it
// knows: linear-quadratic-Gaussian, with the sensors, delays and motors of a level of noise and a vehicle.
//
// About a hover at gap g, z up, d the disturbing force over the mass, a what the rotors' thrust accelerates
// beyond hover, u what is commanded:
//
//   z' = v,   v' = k z + a + d,   a' = (u(t - delay) - a) / tau,   k = -g rho'(gap) / rho(gap)
//   d: none, a walk, or of first order with the gusts' sd and time
//
// Measured: k z + a + d by the accelerometer each ms (white before the firmware's filter, which hides nothing
// from who knows it), z by the downward range each 25 ms, 13 ms late, and by the upward one each 100 ms, 60
// to 80 ms late, where the gap is beyond its floor.
//
// The Kalman filter knows all of it, its variance follows the samples' cycle of 100 ms; the feedback is that
// of least z^2 whose command, beside what cancels d, stays within what the motors have left over hover three
// times its sd. Its own number has to be met by none: it knows mass, lag, delay, curve and ceiling exactly.
//
// Source: Anderson and Moore 1990 (separation, delayed inputs); Chu, Fan, Lin 2004 (doubling).
#ifndef SIM_FLIGHT_BOUND_H
#define SIM_FLIGHT_BOUND_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double sd_m;           // of one sample, rounding included; HUGE_VAL: it does not see the surface
  int period_ms, age_ms; // > 0, divisor of BOUND_CYCLE_MS; of a sample when it comes, less than that
} bound_range_t;

#define BOUND_CYCLE_MS 100 // after which the samples repeat themselves

// The disturbing force over the mass. All zero: none.
typedef struct {
  double walk_mps2;             // >= 0   per root second
  double gust_mps2, gust_tau_s; // >= 0, > 0   sd, correlation time; either this or a walk
} bound_force_t;

typedef struct {
  double stiffness_per_s2; // k: how much stronger the ceiling pulls with every metre that it is nearer
  double tau_s, delay_s;   // of the motors, > 0; of commands, >= 0
  double room_mps2;        // > 0   what the motors have left over hover
  double acc_mps2;         // sd of an accelerometer's sample before its filter
  bound_range_t down, up;
  bound_force_t force;
} bound_plant_t;

typedef struct {
  double rms_m;        // of the height about what is wanted
  double known_m;      // of what the filter knows of it
  double command_mps2; // sd of the command, beside what cancels the force
} bound_t;

bound_t bound_of(const bound_plant_t *plant);

#ifdef __cplusplus
}
#endif

#endif
