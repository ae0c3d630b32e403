// model_file.h - vehicle files (sim/vehicle/vehicles/*.toml).
//
//   name = "..."            and the numbers mass_kg, rotor_radius_m, motor_tau_s, thrust_min_N, thrust_max_N
//   ceiling_m = 0.5         left out: no ceiling
//   wall_y_m = 1.0          left out: no wall that the workflow could find an effect of
//   floor_rise_x = 0.087    and floor_rise_y: how steeply the floor rises along x and y; left out: level
//   [thrust_map]            left out: commands are newton
//   kind = "stand"          five numbers c = [...]; or "volt_cubic", "pwm_cubic" (four), "speed" (three; k
//   w^2
//                           is c = [0, 0, k]): see plant/thrust_map.h
//   [body] [rotors] [battery]   see vehicle/frame_file.h; left out: a Crazyflie scaled to mass and radius, no
//   battery
//   [controller]            who flew its logs: pilots/controller_file.h reads it; left out: not known
//   [[effect]]              any number of them
//   name = "ceiling"        form = "..." where the effect has forms, and its parameters by name;
//                           form "table": file = "FILE.csv" (from the vehicle file's folder), or the lists
//                           distance_over_radius = [...] and ratio = [...]
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
