// model_file.h - vehicle files (sim/vehicle/vehicles/*.toml).
//
// Every key, its unit and what it is where it is left out: README.md. Of [thrust_map] see plant/thrust_map.h,
// of [body], [rotors], [battery] and the ranges vehicle/frame_file.h, of [controller]
// pilots/controller_file.h.
#ifndef SIM_VEHICLE_MODEL_FILE_H
#define SIM_VEHICLE_MODEL_FILE_H

#include "base/error.h"
#include "base/toml.h"
#include "vehicle/model.h"

// For whoever reads a table of the file.
extern const toml_kind_t model_file_kind;

// BAD_INPUT: the file is missing or not TOML, a key is missing, unknown or out of range; *m is kept.
MUST_CHECK done_t model_read(const char *path, model_t *m, why_t *why);

// The same from a text in memory; `path` is what errors call it, and where a `file` of points is looked for.
MUST_CHECK done_t model_read_text(const char *path, const char *text, model_t *m, why_t *why);

// The file of sim/vehicle/vehicles that is called NAME.toml, as it was when the program was built.
// BAD_INPUT: there is none of that name, or it is not good.
MUST_CHECK done_t model_builtin(const char *name, model_t *m, why_t *why);

// The files of sim/vehicle/vehicles, collected by the build.
typedef struct {
  const char *name, *text;
} vehicle_text_t;

extern const vehicle_text_t vehicle_table[];
extern const int vehicle_count;

#endif
