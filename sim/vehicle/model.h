// model.h - what the simulator takes a vehicle and its surroundings to be: numbers, map and effects.
//
// A vehicle file (sim/vehicle/vehicles/*.toml) holds this. Sources of the numbers stand in the file.
#ifndef SIM_VEHICLE_MODEL_H
#define SIM_VEHICLE_MODEL_H

#include "base/error.h"
#include "effects/fx.h"
#include "plant/battery.h"
#include "plant/thrust_map.h"
#include <stdbool.h>

// What six degrees of freedom need besides. Body axes; places from the centre of mass.
typedef struct {
  double inertia_kgm2[3]; // > 0, about the axes
  double rotor_x_m[ROTORS],
      rotor_y_m[ROTORS];     // centres; the firmware's order: front right, back right, back left, front left
  double rotor_spin[ROTORS]; // +1 counter-clockwise seen from above, -1 clockwise
  double torque_ratio_m;     // >= 0   torque over thrust of a rotor
  double kf_Ns2;             // > 0    thrust over speed squared, N/(rad/s)^2
  double rotor_inertia_kgm2; // >= 0   of one propeller with its motor
  double motor_delay_s;      // >= 0   from command to lag, to whole ticks
  double cg_above_feet_m;    // > 0
  double rotor_above_feet_m; // the blades' plane
  double top_above_rotor_m;  // the body's highest points; below 0: the blades touch first
  double top_half_m;         // half the side of the square that the highest points span
  double imu_m[3];           // the accelerometer
} frame_t;

// What the vehicle's range sensors are known to be. `fly` simulates those of a Crazyflie (sense/range.h).
typedef struct {
  bool told;       // by the vehicle file
  double period_s; // >= 0   from sample to sample; 0: as often as anybody looks
  double age_s;    // >= 0   of a sample when it comes
  double noise_m;  // >= 0   standard deviation
  double floor_m;  // >= 0   nearer than this it says this
} range_told_t;

typedef struct {
  char name[64];
  double mass_kg;            // > 0, ready to fly
  double rotor_radius_m;     // > 0
  double motor_tau_s;        // >= 0  first-order lag; below LAG_LEAST_S: none
  double motor_down_over_up; // >= 0 what it is multiplied by while the thrust falls; 0: 1
  bool lag_in_speed;         // of the rotor, else in thrust
  double lag_square[2];      // 0 to 1: up and down, plant/lag.h
  double thrust_min_N;       // of all motors together; below 0 only in the thesis's section 4.2
  double thrust_max_N;       // > thrust_min_N
  thrust_map_t map;          // PWM and volts to newton per motor
  double ceiling_m;          // height of the ceiling, INFINITY: none; z = 0 is the ground
  double wall_y_m;           // a wall in the plane of this y, INFINITY: none; what its air does is an effect
  bool wall_solid;           // and it can be touched
  double floor_rise_x, floor_rise_y; // how steeply the floor rises along x and y: tangents; 0: level
  // What each rotor gives more than the map says, as a share, its torque with it. In no file: a flight draws
  // it.
  double rotor_more[ROTORS];
  frame_t frame;
  bool frame_told;         // by the vehicle file, body and rotors; else it is like a Crazyflie's
  unsigned frame_lacks;    // which keys of them it does not say (vehicle/frame_file.h)
  battery_param_t battery; // capacity 0: none
  range_told_t range_up, range_down;
  int n_fx;
  fx_use_t fx[FX_MAX]; // what acts; at most one of a name
} model_t;

// A Crazyflie 2.1 scaled to the model's mass and rotor radius: what a file says nothing of.
frame_t model_frame_like_crazyflie(const model_t *m);

// Newton that each rotor gives more, for so much lift and moment (body's axes, about the origin) together:
// the smallest that do, of a frame that is symmetric about both axes, with rotors on them or beside. Without
// a torque of the rotors there is no moment about z, nor about an axis on which all of them lie.
void model_mix(const frame_t *f, double lift_N, const double moment_Nm[3], double more_N[ROTORS]);

// The same vehicle as a point with mass and thrust, its rotors' plane, above level ground and without walls.
model_t model_point(const model_t *m);

// Thrust of a rotor in the hover.
double model_steady_N(const model_t *m);

// How its rotors follow, with so much more lag (or less) than the file has.
lag_t model_lag(const model_t *m, double more_s);

// A step of an integrator, at most most_s, that follows its rotors.
double model_step_s(const model_t *m, double most_s);

// What is typical of a number of an effect on this vehicle, over what it is on a Crazyflie.
double model_grows(const model_t *m, fx_grows_t how);

// The smallest that a parameter of an effect can be on this vehicle.
double model_fx_least(const model_t *m, const fx_use_t *use, int param);

// Switches an effect on, or replaces the one of that name. BAD_INPUT: FX_MAX are on already, or the effect
// `mass` leaves less than a tenth of the model's mass.
MUST_CHECK done_t model_add_fx(model_t *m, const fx_use_t *use, why_t *why);

// The floor's normal, world axes, of length 1.
d3_t model_floor_up_w(const model_t *m);

// The effect as the model has it; a null pointer: it has it not.
const fx_use_t *model_fx(const model_t *m, const fx_t *fx);

// Switches it off, if it is on.
void model_drop_fx(model_t *m, const fx_t *fx);

// What the rotors' thrust is multiplied by at this place: 1 and the excess of every effect (thesis 3.1.4).
double model_thrust_ratio(const model_t *m, const fx_place_t *place);

// What the model's effects make of a sensor's reading.
void model_sense(const model_t *m, fx_sensed_t *sensed);

#endif
