// model.h - the simulator's model of a vehicle and its surroundings: numbers, thrust map and effects.
//
// A vehicle file (sim/vehicle/vehicles/*.toml) holds these, with the sources of the numbers.
#ifndef SIM_VEHICLE_MODEL_H
#define SIM_VEHICLE_MODEL_H

#include "base/error.h"
#include "effects/fx.h"
#include "plant/battery.h"
#include "plant/thrust_map.h"
#include <stdbool.h>

// What six degrees of freedom need in addition. Body axes; positions relative to the centre of mass.
typedef struct {
  double inertia_kgm2[3]; // > 0, about the axes
  double rotor_x_m[ROTORS],
      rotor_y_m[ROTORS];     // centres; the firmware's order: front right, back right, back left, front left
  double rotor_spin[ROTORS]; // +1 counter-clockwise seen from above, -1 clockwise
  double torque_ratio_m;     // >= 0   torque over thrust of a rotor
  double kf_Ns2;             // > 0    thrust over speed squared, N/(rad/s)^2
  double rotor_inertia_kgm2; // >= 0   of one propeller with its motor
  double motor_delay_s;      // >= 0   from command to lag, rounded to whole ticks
  double cg_above_feet_m;    // > 0
  double rotor_above_feet_m; // the blades' plane
  double top_above_rotor_m;  // to the body's highest points; below 0: the blades touch first
  double top_half_m;         // half the side of the square that the highest points span
  double imu_m[3];           // the accelerometer
} frame_t;

// What is known of the vehicle's range sensors. `fly` simulates those of a Crazyflie (sense/range.h).
typedef struct {
  bool told;       // the vehicle file says it
  double period_s; // >= 0   between samples; 0: a sample whenever it is read
  double age_s;    // >= 0   of a sample when it arrives
  double noise_m;  // >= 0   standard deviation
  double floor_m;  // >= 0   the reading at smaller distances
} range_told_t;

typedef struct {
  char name[64];
  double mass_kg;            // > 0, ready to fly
  double rotor_radius_m;     // > 0
  double motor_tau_s;        // >= 0  first-order lag; below LAG_LEAST_S: no lag
  double motor_down_over_up; // >= 0 factor of the lag while the thrust falls; 0: 1
  bool lag_in_speed;         // in the rotor's speed, else in its thrust
  double lag_square[2];      // 0 to 1: up and down, see plant/lag.h
  double thrust_min_N;       // of all motors together; below 0 only in section 4.2 of the thesis
  double thrust_max_N;       // > thrust_min_N
  thrust_map_t map;          // newton per motor from PWM and voltage
  double ceiling_m;          // height of the ceiling, INFINITY: none; z = 0 is the ground
  double wall_y_m;           // of a wall in this plane, INFINITY: none; its aerodynamics are an effect
  bool wall_solid;           // the wall can be touched
  double floor_rise_x, floor_rise_y; // tangents of the floor's slope along x and y; 0: level
  // Share by which each rotor gives more thrust and torque than the map says. In no file: drawn for a flight.
  double rotor_more[ROTORS];
  frame_t frame;
  bool frame_told;         // the vehicle file says body and rotors; else they are like a Crazyflie's
  unsigned frame_lacks;    // which of their keys it does not say (vehicle/frame_file.h)
  battery_param_t battery; // capacity 0: none
  range_told_t range_up, range_down;
  int n_fx;
  fx_use_t fx[FX_MAX]; // effects that are on; at most one of each name
} model_t;

// A Crazyflie 2.1 scaled to the model's mass and rotor radius, for what a file does not say.
frame_t model_frame_like_crazyflie(const model_t *m);

// The additional thrusts, N, that together give this lift and moment (body axes, about the origin): the
// smallest ones, for a frame that is symmetric about both axes, with rotors on or beside them. There is no
// moment about z if the rotors have no torque, and none about an axis on which all rotors lie.
void model_mix(const frame_t *f, double lift_N, const double moment_Nm[3], double more_N[ROTORS]);

// The same vehicle as a point with mass and thrust, in its rotors' plane, above level ground, with neither
// walls nor battery.
model_t model_point(const model_t *m);

// A rotor's thrust in hover.
double model_steady_N(const model_t *m);

// How its rotors follow their commands, with a lag more_s longer (or shorter) than in the file.
lag_t model_lag(const model_t *m, double more_s);

// An integrator step, at most most_s, that is short enough for its rotors.
double model_step_s(const model_t *m, double most_s);

// The typical size of an effect's number on this vehicle, over that on a Crazyflie.
double model_grows(const model_t *m, fx_grows_t how);

// The smallest value that a parameter of an effect may have on this vehicle.
double model_fx_least(const model_t *m, const fx_use_t *use, int param);

// Switches an effect on, or replaces the one of the same name. BAD_INPUT: FX_MAX effects are on already, or
// the effect `mass` leaves less than a tenth of the model's mass.
MUST_CHECK done_t model_add_fx(model_t *m, const fx_use_t *use, why_t *why);

// The floor's unit normal, world axes.
d3_t model_floor_up_w(const model_t *m);

// The effect as the model has it; null if it is off.
const fx_use_t *model_fx(const model_t *m, const fx_t *fx);

// Switches the effect off, if it is on.
void model_drop_fx(model_t *m, const fx_t *fx);

// The factor of a rotor's thrust at this place: 1 plus the excess of every effect (thesis 3.1.4).
double model_thrust_ratio(const model_t *m, const fx_place_t *place);

// Applies the model's effects on sensors to a reading.
void model_sense(const model_t *m, fx_sensed_t *sensed);

#endif
