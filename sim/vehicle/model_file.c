// model_file.c - vehicle files.
#define _POSIX_C_SOURCE 200809L // access
#include "vehicle/model_file.h"

#include "base/constants.h"
#include "base/folder.h"
#include "base/nearest.h"
#include "base/toml.h"
#include "vehicle/effect_spec.h"
#include "vehicle/frame_file.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// Thrust over weight. The quickest vehicle of the thesis has 20, racers have 15.
#define LIFT_MIN 1.0
#define LIFT_MAX 50.0

static done_t read_map(toml_t t, thrust_map_t *map, why_t *why) {
  static const char *const keys[] = {"kind", "c", NULL};
  static const struct {
    const char *name;
    thrust_map_kind_t kind;
    int n;
  } kinds[] = {{"stand", THRUST_MAP_STAND, 5},
               {"volt_cubic", THRUST_MAP_VOLT_CUBIC, 4},
               {"pwm_cubic", THRUST_MAP_PWM_CUBIC, 4},
               {"speed", THRUST_MAP_SPEED, 3}};
  char name[32];
  TRY(toml_only(t, keys, why));
  TRY(toml_string(t, "kind", name, sizeof name, why));
  for (unsigned i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    if (strcmp(kinds[i].name, name) != 0) continue;
    int n;
    TRY(toml_doubles(t, "c", 5, map->c, &n, why));
    if (n != kinds[i].n) return toml_refuse(t, "c", why, "%d numbers; allowed: %d", n, kinds[i].n);
    map->kind = kinds[i].kind;
    return DONE;
  }
  return toml_refuse(t, "kind", why, "unknown kind `%s`; allowed: stand, volt_cubic, pwm_cubic, speed", name);
}

// Reads `file`, relative to the folder of the vehicle file.
static done_t points_from_file(toml_t t, const char *model_path, curve_points_t *points, why_t *why) {
  char file[256], path[600];
  TRY(toml_string(t, "file", file, sizeof file, why));
  const int folder = file[0] != '/' ? folder_size(model_path) : 0;
  snprintf(path, sizeof path, "%.*s%s", folder, model_path, file);
  return effect_read_points(points, path, why);
}

static done_t points_from_lists(toml_t t, curve_points_t *points, why_t *why) {
  int n_ratio;
  TRY(toml_doubles(t, "distance_over_radius", CURVE_POINTS_MAX, points->x, &points->n, why));
  TRY(toml_doubles(t, "ratio", CURVE_POINTS_MAX, points->ratio, &n_ratio, why));
  if (n_ratio != points->n)
    return toml_refuse(t, "ratio", why, "%d numbers; allowed: as many as distance_over_radius, %d", n_ratio,
                       points->n);
  return DONE;
}

// Passes on an error from effect_spec, with file and line.
static done_t located(toml_t t, const char *key, done_t status, const why_t *cause, why_t *why) {
  return status == DONE ? DONE : toml_refuse(t, key, why, "%s", cause->text);
}

static bool is_list_key(const char *key) {
  return strcmp(key, "distance_over_radius") == 0 || strcmp(key, "ratio") == 0;
}

static done_t read_points(toml_t t, const char *model_path, fx_use_t *use, why_t *why) {
  if (!use->form || !use->form->needs_points) return DONE;
  curve_points_t points = {0};
  why_t cause;
  if (toml_has(t, "file"))
    TRY(points_from_file(t, model_path, &points, why));
  else
    TRY(points_from_lists(t, &points, why));
  return located(t, toml_has(t, "file") ? "file" : "ratio", effect_set_points(use, &points, &cause), &cause,
                 why);
}

static done_t read_effect(toml_t t, const char *model_path, fx_use_t *use, why_t *why) {
  char text[64];
  why_t cause;
  TRY(toml_string(t, "name", text, sizeof text, why));
  TRY(located(t, "name", effect_start(use, text, &cause), &cause, why));
  if (toml_has(t, "form")) {
    TRY(toml_string(t, "form", text, sizeof text, why));
    TRY(located(t, "form", effect_set_form(use, text, &cause), &cause, why));
  }
  TRY(read_points(t, model_path, use, why));
  const bool points = use->form && use->form->needs_points;
  const char *key;
  for (int i = 0; (key = toml_key(t, i)) != NULL; i++) {
    if (strcmp(key, "name") == 0 || strcmp(key, "form") == 0) continue;
    if (points && (strcmp(key, "file") == 0 || is_list_key(key))) continue;
    // An unknown key is reported with a list of the allowed ones, whatever its value's type.
    double value = 0.0;
    if (toml_double(t, key, -HUGE_VAL, HUGE_VAL, &value, &cause) != DONE) value = (double)NAN;
    if (effect_set(use, key, value, &cause) != DONE)
      return toml_refuse(t, key, why, "%s%s", cause.text, toml_astray(t, key));
  }
  return DONE;
}

static done_t read_effects(toml_t root, const char *path, model_t *m, why_t *why) {
  for (int i = 0;; i++) {
    toml_t t;
    bool more;
    fx_use_t use;
    why_t cause;
    TRY(toml_table_at(root, "effect", i, &t, &more, why));
    if (!more) return DONE;
    TRY(read_effect(t, path, &use, why));
    for (int k = 0; k < m->n_fx; k++)
      if (m->fx[k].fx == use.fx)
        return toml_refuse(t, "name", why, "effect %s stands twice; allowed: once", use.fx->name);
    TRY(located(t, "name", model_add_fx(m, &use, &cause), &cause, why));
  }
}

static done_t read_numbers(toml_t root, model_t *m, why_t *why) {
  const struct {
    const char *key;
    double min, max, *value;
  } row[] = {
      {"mass_kg", 1e-3, 100.0, &m->mass_kg},         {"rotor_radius_m", 1e-3, 2.0, &m->rotor_radius_m},
      {"motor_tau_s", 0.0, 2.0, &m->motor_tau_s},    {"thrust_min_N", -1e4, 1e4, &m->thrust_min_N},
      {"thrust_max_N", -1e4, 1e4, &m->thrust_max_N},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    TRY(toml_double(root, row[i].key, row[i].min, row[i].max, row[i].value, why));
  if (!(m->thrust_max_N > m->thrust_min_N))
    return toml_refuse(root, "thrust_max_N", why, "%g; allowed: more than thrust_min_N, %g", m->thrust_max_N,
                       m->thrust_min_N);
  return DONE;
}

static done_t read_lag_square(toml_t root, model_t *m, why_t *why) {
  const char *const key = "lag_square";
  int n = 0;
  if (!toml_has(root, key)) return DONE;
  TRY(toml_doubles(root, key, 2, m->lag_square, &n, why));
  if (!m->lag_in_speed) return toml_refuse(root, key, why, "allowed: with lag_in = \"speed\"");
  for (int i = 0; i < 2; i++)
    if (n != 2 || !(m->lag_square[i] >= 0.0 && m->lag_square[i] <= 1.0))
      return toml_refuse(root, key, why, "allowed: two numbers from 0 to 1, up and down");
  return DONE;
}

// How the rotors follow their commands. The default is a lag in speed, as motors have it.
static done_t read_lag(toml_t root, model_t *m, why_t *why) {
  char in[16] = "speed";
  double down_s = m->motor_tau_s;
  if (toml_has(root, "lag_in")) TRY(toml_string(root, "lag_in", in, sizeof in, why));
  if (strcmp(in, "speed") != 0 && strcmp(in, "thrust") != 0)
    return toml_refuse(root, "lag_in", why, "unknown word `%s`; allowed: speed, thrust", in);
  if (toml_has(root, "motor_tau_down_s"))
    TRY(toml_double(root, "motor_tau_down_s", LAG_LEAST_S, 2.0, &down_s, why));
  m->lag_in_speed = strcmp(in, "speed") == 0;
  TRY(read_lag_square(root, m, why));
  m->motor_down_over_up = m->motor_tau_s >= LAG_LEAST_S ? down_s / m->motor_tau_s : 1.0;
  return DONE;
}

// Grams for kilograms, or millinewton for newton, give a vehicle that cannot leave the ground or that no
// integrator step can follow.
static done_t check_lift(toml_t root, const model_t *m, why_t *why) {
  const double weight_N = m->mass_kg * G_MPS2, lift = m->thrust_max_N / weight_N;
  if (lift > LIFT_MIN && lift <= LIFT_MAX) return DONE;
  const double most_kg = m->thrust_max_N / G_MPS2;
  if (!(most_kg > 0.0))
    return toml_refuse(root, "thrust_max_N", why,
                       "%g; allowed: more than the weight, %.3g N, of all rotors together", m->thrust_max_N,
                       weight_N);
  if (lift <= LIFT_MIN && ROTORS * lift > LIFT_MIN)
    return toml_refuse(
        root, "thrust_max_N", why,
        "%g, and mass_kg weighs %.3g N; allowed: more than that, of all rotors together (is it "
        "of one?)",
        m->thrust_max_N, weight_N);
  return toml_refuse(
      root, "mass_kg", why,
      "%g kg weigh %.3g N, and thrust_max_N, of all rotors together, is %g; allowed with that: "
      "%.3g to %.3g kg",
      m->mass_kg, weight_N, m->thrust_max_N, most_kg / LIFT_MAX, most_kg / LIFT_MIN);
}

static const char *const ROOT_KEYS[] = {
    "name",         "mass_kg",      "rotor_radius_m", "motor_tau_s", "motor_tau_down_s", "lag_in",
    "lag_square",   "thrust_min_N", "thrust_max_N",   "ceiling_m",   "wall_y_m",         "floor_rise_x",
    "floor_rise_y", "thrust_map",   "body",           "rotors",      "battery",          "controller",
    "range_up",     "range_down",   "effect",         NULL};
const toml_kind_t model_file_kind = {"a vehicle file", "sim/vehicle/vehicles/cf21_legacy.toml", ROOT_KEYS};

static done_t read_root(toml_t root, const char *path, model_t *m, why_t *why) {
  TRY(toml_only(root, ROOT_KEYS, why));
  TRY(toml_string(root, "name", m->name, sizeof m->name, why));
  TRY(read_numbers(root, m, why));
  TRY(read_lag(root, m, why));
  TRY(check_lift(root, m, why));
  if (toml_has(root, "ceiling_m")) TRY(toml_double(root, "ceiling_m", 0.05, 1e3, &m->ceiling_m, why));
  if (toml_has(root, "wall_y_m")) TRY(toml_double(root, "wall_y_m", -1e3, 1e3, &m->wall_y_m, why));
  if (toml_has(root, "floor_rise_x"))
    TRY(toml_double(root, "floor_rise_x", -1.0, 1.0, &m->floor_rise_x, why));
  if (toml_has(root, "floor_rise_y"))
    TRY(toml_double(root, "floor_rise_y", -1.0, 1.0, &m->floor_rise_y, why));
  if (toml_has(root, "thrust_map")) {
    toml_t map;
    TRY(toml_table(root, "thrust_map", &map, why));
    TRY(read_map(map, &m->map, why));
  }
  TRY(frame_read(root, m, why));
  return read_effects(root, path, m, why);
}

static done_t read_file(toml_file_t *file, const char *path, model_t *m, why_t *why) {
  model_t fresh = {.ceiling_m = HUGE_VAL, .wall_y_m = HUGE_VAL, .map = {.kind = THRUST_MAP_NONE}};
  const done_t status = read_root(toml_root(file), path, &fresh, why);
  toml_close(file);
  if (status == DONE) *m = fresh;
  return status;
}

// For a missing file: suggests the vehicle whose name the file has, or nearly has.
static done_t no_file(const char *path, why_t *why) {
  const char *const name = folder_file(path);
  char word[NEAREST_LETTERS + 1] = "";
  const size_t size = strlen(name), end = size > 5 && strcmp(name + size - 5, ".toml") == 0 ? size - 5 : size;
  if (end < sizeof word) memcpy(word, name, end);
  nearest_t nearest = nearest_to(word);
  for (int i = 0; i < vehicle_count; i++) nearest_try(&nearest, vehicle_table[i].name);
  if (!nearest.name) return DONE;
  return error_set(
      why, "%.200s: cannot be opened: No such file or directory (did you mean sim/vehicle/vehicles/%s.toml?)",
      path, nearest.name);
}

done_t model_read(const char *path, model_t *m, why_t *why) {
  if (access(path, F_OK) != 0) TRY(no_file(path, why));
  toml_file_t *file;
  TRY(toml_open(&file, path, &model_file_kind, why));
  return read_file(file, path, m, why);
}

done_t model_read_text(const char *path, const char *text, model_t *m, why_t *why) {
  toml_file_t *file;
  TRY(toml_open_text(&file, path, text, &model_file_kind, why));
  return read_file(file, path, m, why);
}

done_t model_builtin(const char *name, model_t *m, why_t *why) {
  for (int i = 0; i < vehicle_count; i++) {
    if (strcmp(vehicle_table[i].name, name) != 0) continue;
    return model_read_text(name, vehicle_table[i].text, m, why);
  }
  return error_set(why, "%s: no vehicle of that name was built in", name);
}
