// frame_file.h - reads body, rotors, battery and range sensors from a vehicle file: README.md lists the keys.
//
// Every key is optional, except those of a [battery] that is present.
#ifndef SIM_VEHICLE_FRAME_FILE_H
#define SIM_VEHICLE_FRAME_FILE_H

#include "base/error.h"
#include "base/toml.h"
#include "vehicle/model.h"

#define FRAME_LACKS 240 // bytes

// m->mass_kg and m->rotor_radius_m must be set. BAD_INPUT: a key is unknown, of another type or out of range.
MUST_CHECK done_t frame_read(toml_t root, model_t *m, why_t *why);

// Lists what the file does not say and a scaled Crazyflie's numbers replace: "[body], rotors.kf_Ns2"; empty
// if nothing. Keys whose default is 0 do not count. Returns text.
const char *frame_lacks(const model_t *m, char text[FRAME_LACKS]);
// True if this key is one of them.
bool frame_lacks_key(const model_t *m, const char *table, const char *key);

#endif
