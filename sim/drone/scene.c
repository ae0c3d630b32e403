// scene.c - where simulated vehicles fly for clients.
#include "drone/scene.h"

#include "base/folder.h"
#include "base/number.h"
#include "drone/rows.h"
#include "flight/request_spec.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define CEILING_M 1.5
#define TEXT_MAX  256

static const char *const keys[] = {"vehicle",      "noise",        "seed",     "ceiling_m",
                                   "floor_rise_x", "floor_rise_y", "wall_y_m", "battery",
                                   "effect",       "event",        NULL};
static const char *const effect_keys[] = {"is", NULL};
static const char *const event_keys[] = {"at_s", "set", NULL};
static const toml_kind_t kind = {
    "a scene", "vehicle = \"cf21_legacy\", ceiling_m = 1.5, [[effect]] is = \"ceiling:Ca=0.6\"", keys};

done_t scene_default(scene_t *scene, why_t *why) {
  *scene = (scene_t){.battery = 1.0, .seed = 1};
  TRY(setup_thesis(&scene->setup, FLY_INDI, why));
  scene->setup.model.ceiling_m = CEILING_M;
  return DONE;
}

done_t scene_apply(scene_t *scene, const request_t *request, why_t *why) {
  TRY(setup_apply(&scene->setup, request, why));
  scene->setup.request = NULL; // it is the caller's
  return DONE;
}

static done_t number(toml_t t, const char *key, double min, double max, double *value, why_t *why) {
  return toml_has(t, key) ? toml_double(t, key, min, max, value, why) : DONE;
}

static bool is_path(const char *name) {
  return strchr(name, '/') || strstr(name, ".toml");
}

// A path is relative to the scene's folder.
static done_t take_vehicle(toml_t t, const char *scene_path, model_t *model, why_t *why) {
  char name[TEXT_MAX], path[2 * TEXT_MAX + 1];
  TRY(toml_string(t, "vehicle", name, sizeof name, why));
  if (!is_path(name)) {
    if (model_builtin(name, model, why) == DONE) return DONE;
    return toml_refuse(t, "vehicle", why, "%s: allowed is one of sim/vehicle/vehicles, or a file's path",
                       name);
  }
  const int folder = name[0] != '/' ? folder_size(scene_path) : 0;
  if (folder > TEXT_MAX)
    return toml_refuse(t, "vehicle", why, "the path is too long; allowed are 256 characters");
  snprintf(path, sizeof path, "%.*s%s", folder, scene_path, name);
  return model_read(path, model, why);
}

static done_t take_effects(toml_t root, request_t *request, why_t *why) {
  for (int i = 0;; i++) {
    toml_t t;
    bool more;
    char text[TEXT_MAX];
    why_t said;
    TRY(toml_table_at(root, "effect", i, &t, &more, why));
    if (!more) return DONE;
    TRY(toml_only(t, effect_keys, why));
    TRY(toml_string(t, "is", text, sizeof text, why));
    if (request_take_effect(request, text, &said) != DONE) return toml_refuse(t, "is", why, "%s", said.text);
  }
}

// "NAME=VALUE"
static done_t take_set(toml_t t, event_t *event, why_t *why) {
  char text[TEXT_MAX];
  why_t said;
  TRY(toml_string(t, "set", text, sizeof text, why));
  char *const equals = strchr(text, '=');
  if (!equals || !number_parse(equals + 1, &event->value))
    return toml_refuse(t, "set", why, "%s; allowed: NAME=VALUE, of the group desk", text);
  *equals = '\0';
  if (desk_param_check(text, event->value, &said) != DONE) return toml_refuse(t, "set", why, "%s", said.text);
  event->param = desk_param_find(text);
  return DONE;
}

static done_t take_events(toml_t root, scene_t *scene, why_t *why) {
  for (int i = 0;; i++) {
    toml_t t;
    bool more;
    TRY(toml_table_at(root, "event", i, &t, &more, why));
    if (!more) return DONE;
    TRY(toml_only(t, event_keys, why));
    if (i == SCENE_EVENTS)
      return toml_refuse(t, "at_s", why, "one event too many; allowed: %d", SCENE_EVENTS);
    event_t *const event = &scene->event[scene->n_event++];
    const double before_s = i > 0 ? event[-1].at_s : 0.0;
    TRY(toml_double(t, "at_s", before_s, 1e6, &event->at_s, why));
    TRY(take_set(t, event, why));
  }
}

static done_t take(toml_t t, const char *path, scene_t *scene, why_t *why) {
  model_t vehicle;
  request_t request = {.seed = scene->seed};
  char text[TEXT_MAX];
  if (toml_has(t, "vehicle")) {
    TRY(take_vehicle(t, path, &vehicle, why));
    request.vehicle = &vehicle;
  }
  if (toml_has(t, "noise")) {
    TRY(toml_string(t, "noise", text, sizeof text, why));
    why_t said;
    if (request_take_noise(&request, text, &said) != DONE)
      return toml_refuse(t, "noise", why, "%s", said.text);
  }
  TRY(take_effects(t, &request, why));
  TRY(scene_apply(scene, &request, why));
  model_t *const m = &scene->setup.model;
  double seed = (double)scene->seed;
  TRY(number(t, "seed", 0.0, 1e9, &seed, why));
  if (seed != floor(seed)) return toml_refuse(t, "seed", why, "%g; allowed: a whole number", seed);
  scene->seed = (uint64_t)seed;
  TRY(number(t, "ceiling_m", 0.15, 10.0, &m->ceiling_m, why));
  if (m->ceiling_m >= 10.0) m->ceiling_m = HUGE_VAL;
  TRY(number(t, "floor_rise_x", -0.5, 0.5, &m->floor_rise_x, why));
  TRY(number(t, "floor_rise_y", -0.5, 0.5, &m->floor_rise_y, why));
  m->wall_solid = m->wall_solid || toml_has(t, "wall_y_m");
  TRY(number(t, "wall_y_m", -100.0, 100.0, &m->wall_y_m, why));
  TRY(take_events(t, scene, why));
  return number(t, "battery", 0.01, 1.0, &scene->battery, why);
}

done_t scene_read(const char *path, scene_t *scene, why_t *why) {
  toml_file_t *file;
  TRY(toml_open(&file, path, &kind, why));
  scene_t read = *scene;
  done_t status = toml_only(toml_root(file), keys, why);
  if (status == DONE) status = take(toml_root(file), path, &read, why);
  toml_close(file);
  if (status == DONE) *scene = read;
  return status;
}

done_t scene_take(scene_t *scene, const char *path, request_t *request, bool seed_said, why_t *why) {
  TRY(scene_default(scene, why));
  if (path) TRY(scene_read(path, scene, why));
  if (!seed_said) request->seed = scene->seed;
  scene->seed = request->seed;
  return scene_apply(scene, request, why);
}
