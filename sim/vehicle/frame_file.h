// frame_file.h - what a vehicle file says of body, rotors, battery and range sensors: the keys stand in
// README.md.
//
// Every key may be left out, but those of a [battery] that is there.
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
// Whether it is this key of them.
bool frame_lacks_key(const model_t *m, const char *table, const char *key);

#endif
