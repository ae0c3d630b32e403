// bound.h - the least height error that any linear controller could have below a ceiling whose height it
// knows (linear-quadratic-Gaussian), with the sensors, delays and motors of a level of noise and a vehicle.
//
// The plant is linearised about a hover. z: height, up; v: climb; a: acceleration by the rotors' thrust
// beyond hover; u: commanded acceleration; d: disturbing force over mass; g: gravity; rho: thrust ratio at a
// gap:
//
//   z' = v,   v' = k z + a + d,   a' = (u(t - delay) - a) / tau,   k = -g rho'(gap) / rho(gap)
//   d: 0, a random walk, or first-order with the gusts' sd and correlation time
//
// The accelerometer measures k z + a + d every ms; its noise is white before the firmware's filter, which
// hides nothing from a controller that knows it. The downward range sensor measures z every 25 ms, 13 ms
// late, and the upward one every 100 ms, 60 to 80 ms late, where the gap exceeds its floor.
//
// The Kalman filter knows this model, and its covariance repeats with the samples' cycle of 100 ms. The
// feedback minimises z^2 while three sd of its command, without the part that cancels d, stay within what the
// motors have left over hover. No real controller need reach the bound: it assumes mass, lag, delay, curve
// and ceiling known exactly.
//
// Source: Anderson and Moore 1990 (separation, delayed inputs); Chu, Fan, Lin 2004 (doubling).
#ifndef SIM_FLIGHT_BOUND_H
#define SIM_FLIGHT_BOUND_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double sd_m;           // sd of one sample, rounding included; HUGE_VAL: the sensor does not see the surface
  int period_ms, age_ms; // > 0, divides BOUND_CYCLE_MS; age of a sample on arrival, less than BOUND_CYCLE_MS
} bound_range_t;

#define BOUND_CYCLE_MS 100 // after which the pattern of samples repeats

// Disturbing force over the mass. All zero: none.
typedef struct {
  double walk_mps2;             // >= 0   random walk, per root second
  double gust_mps2, gust_tau_s; // >= 0, > 0   sd, correlation time; with sd > 0 there is no walk
} bound_force_t;

typedef struct {
  double stiffness_per_s2; // k: growth of the ceiling's pull per metre nearer, over the mass
  double tau_s, delay_s;   // lag of the motors, > 0; delay of commands, >= 0
  double room_mps2;        // > 0   acceleration that the motors have left over hover
  double acc_mps2;         // sd of an accelerometer's sample before its filter
  bound_range_t down, up;
  bound_force_t force;
} bound_plant_t;

typedef struct {
  double rms_m;        // of the height error
  double known_m;      // rms error of the filter's estimate of the height
  double command_mps2; // sd of the command, without the part that cancels the force
} bound_t;

// Returns the bound of this plant.
bound_t bound_of(const bound_plant_t *plant);

#ifdef __cplusplus
}
#endif

#endif
