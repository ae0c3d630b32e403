// frame_file.h - what a vehicle file says of body, rotors and battery. Every key may be left out.
//
//   - [body]: inertia_kgm2 = [x, y, z], cg_above_feet_m, rotor_above_feet_m, top_above_rotor_m, top_half_m;
//     imu_m = [x, y, z], the accelerometer from the centre of mass
//   - [rotors]: x_m, y_m, spin, four numbers each: front right, back right, back left, front left;
//     torque_ratio_m, kf_Ns2, inertia_kgm2, delay_s
//   - [battery], of which the first five keys are needed where there is one: capacity_Ah, resistance_ohm,
//     idle_A, a_ApN, b_ApN2; open_V, 2 to 21 numbers from empty to full, at equal steps of charge
#ifndef SIM_VEHICLE_FRAME_FILE_H
#define SIM_VEHICLE_FRAME_FILE_H

#include "base/error.h"
#include "base/toml.h"
#include "vehicle/model.h"

#define FRAME_LACKS 240 // bytes

// Needs m->mass_kg and m->rotor_radius_m. BAD_INPUT: a key is unknown, of another type, or out of range.
MUST_CHECK done_t frame_read(toml_t root, model_t *m, why_t *why);

// What the file does not say and a Crazyflie's, scaled, stands in for: "[body], rotors.kf_Ns2"; empty:
// nothing. A key that is 0 where it is left out is no part of it. Returns text.
const char *frame_lacks(const model_t *m, char text[FRAME_LACKS]);

#endif
