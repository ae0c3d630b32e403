// model_file.h - reads vehicle files (sim/vehicle/vehicles/*.toml).
//
// README.md has every key, its unit and its default. See plant/thrust_map.h for [thrust_map],
// vehicle/frame_file.h for [body], [rotors], [battery] and the ranges, pilots/controller_file.h for
// [controller].
#ifndef SIM_VEHICLE_MODEL_FILE_H
#define SIM_VEHICLE_MODEL_FILE_H

#include "base/error.h"
#include "base/toml.h"
#include "vehicle/model.h"

// For code that reads a table of the file.
extern const toml_kind_t model_file_kind;

// BAD_INPUT: the file is missing or not TOML, or a key is missing, unknown or out of range; *m is unchanged.
MUST_CHECK done_t model_read(const char *path, model_t *m, why_t *why);

// The same from text in memory. `path` is its name in errors; a `file` of points is relative to its folder.
MUST_CHECK done_t model_read_text(const char *path, const char *text, model_t *m, why_t *why);

// Reads NAME.toml of sim/vehicle/vehicles as it was when the program was built. BAD_INPUT: there is none of
// that name, or it is not valid.
MUST_CHECK done_t model_builtin(const char *name, model_t *m, why_t *why);

// The files in sim/vehicle/vehicles, collected by the build.
typedef struct {
  const char *name, *text;
} vehicle_text_t;

extern const vehicle_text_t vehicle_table[];
extern const int vehicle_count;

#endif
