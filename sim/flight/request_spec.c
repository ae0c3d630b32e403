// request_spec.c - parses what the command line asks for.
#define _POSIX_C_SOURCE 200809L // getline
#include "flight/request_spec.h"

#include "base/nearest.h"
#include "base/number.h"
#include "pilots/param_spec.h"
#include "vehicle/effect_spec.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NAME_MAX 24
#define ITEM_MAX 64

done_t request_take_controller(request_t *r, fly_kind_t *kind, const char *name, why_t *why) {
  char hint[NEAREST_HINT];
  nearest_t nearest = nearest_to(name);
  for (int i = 0; i < FLY_COUNT; i++) {
    if (fly_name[i]) nearest_try(&nearest, fly_name[i]);
    if (!fly_name[i] || strcmp(fly_name[i], name) != 0) continue;
    *kind = (fly_kind_t)i;
    r->kind = kind;
    return DONE;
  }
  return error_set(
      why,
      "--controller %s%s: allowed are indi, indi-theory, indi-rbf, indi-learned; on the vertical axis "
      "pid, pid-ff; in six degrees of freedom stock-pid, stock-indi, air-garage",
      name, nearest_hint(&nearest, hint));
}

done_t request_take_log_rate(request_t *r, const char *text, why_t *why) {
  r->log_500_Hz = strcmp(text, "500") == 0;
  r->log_calls = strcmp(text, "1000") == 0;
  if (r->log_500_Hz || r->log_calls || strcmp(text, "100") == 0) return DONE;
  return error_set(why, "--log-rate %s: allowed are 100, 500, 1000", text);
}

static bool is_field(const char *name) {
  for (int i = 0; i < noise_field_count; i++)
    if (strcmp(noise_fields[i].name, name) == 0) return true;
  return false;
}

// Sets one of the level's numbers, as "acc.z=0.1".
static done_t set_noise(noise_t *noise, const char *item, why_t *why) {
  char name[NAME_MAX] = "";
  const size_t size = strcspn(item, "=");
  double value;
  if (item[size] == '=' && size < sizeof name) {
    memcpy(name, item, size);
    name[size] = '\0';
    if (number_parse(item + size + 1, &value) && noise_set(noise, name, value)) return DONE;
  }
  char hint[NEAREST_HINT];
  nearest_t nearest = nearest_to(name);
  for (int i = 0; i < noise_field_count; i++) nearest_try(&nearest, noise_fields[i].name);
  return error_set(why, "--noise %s%s: allowed is KEY=VALUE, keys and ranges as fly --list shows them", item,
                   is_field(name) ? "" : nearest_hint(&nearest, hint));
}

static done_t check_span(const char *what, double min, double max, why_t *why) {
  if (min <= max) return DONE;
  return error_set(why, "--noise vary.%s.min=%g, vary.%s.max=%g: allowed is min <= max", what, min, what,
                   max);
}

static done_t take_numbers(request_t *r, const char *items, why_t *why) {
  char item[ITEM_MAX];
  for (size_t size; *items; items += size + (items[size] == ',')) {
    size = strcspn(items, ",");
    if (size >= sizeof item) return error_set(why, "--noise %s: too long; allowed is KEY=VALUE,...", items);
    memcpy(item, items, size);
    item[size] = '\0';
    TRY(set_noise(&r->noise_changed, item, why));
  }
  const vary_t *const vary = &r->noise_changed.vary;
  TRY(check_span("gust", vary->gust_min_mps2, vary->gust_max_mps2, why));
  TRY(check_span("top", vary->top_min_m, vary->top_max_m, why));
  r->noise = &r->noise_changed;
  return DONE;
}

// Takes a level of six degrees of freedom, and the numbers that are changed in it.
static done_t take_noise(request_t *r, const char *spec, bool *there, why_t *why) {
  const size_t size = strcspn(spec, ":");
  char name[NAME_MAX] = "";
  if (size < sizeof name) memcpy(name, spec, size);
  r->noise = noise_find(name);
  *there = r->noise != NULL;
  if (!*there || !spec[size]) return DONE;
  r->noise_changed = *r->noise;
  return take_numbers(r, spec + size + 1, why);
}

done_t request_take_noise(request_t *r, const char *name, why_t *why) {
  bool six;
  r->vertical_noise = NULL;
  TRY(take_noise(r, name, &six, why));
  if (six) return DONE;
  for (int i = 0; i < vertical_noise_count; i++) {
    if (strcmp(vertical_noise_levels[i].name, name) != 0) continue;
    r->vertical_noise = &vertical_noise_levels[i];
    return DONE;
  }
  char hint[NEAREST_HINT];
  nearest_t nearest = nearest_to(name);
  for (int i = 0; i < vertical_noise_count; i++) nearest_try(&nearest, vertical_noise_levels[i].name);
  for (int i = 0; i < noise_count; i++) nearest_try(&nearest, noise_levels[i].name);
  return error_set(
      why,
      "--noise %s%s: allowed are none, n1, n2, n3 on the vertical axis, quiet, real, flown in six "
      "degrees of freedom",
      name, nearest_hint(&nearest, hint));
}

done_t request_take_integrator(request_t *r, const char *name, why_t *why) {
  static const char *const names[] = {"sundials", "rk4", "reference", NULL};
  char hint[NEAREST_HINT];
  for (int i = 0; i < 3; i++) {
    if (strcmp(names[i], name) != 0) continue;
    r->integrate = (integrate_kind_t)i;
    return DONE;
  }
  return error_set(why, "--integrator %s%s: allowed are sundials, rk4, reference", name,
                   nearest_of(name, names, hint));
}

done_t request_take_set(request_t *r, const char *text, why_t *why) {
  if (r->n_set == REQUEST_MAX) return error_set(why, "--set: at most %d of them", REQUEST_MAX);
  TRY(param_parse(text, &r->set[r->n_set], why));
  r->n_set++;
  return DONE;
}

done_t request_take_sets(request_t *r, const char *path, why_t *why) {
  FILE *const file = fopen(path, "r");
  if (!file) return error_set(why, "%s: cannot be read", path);
  char *line = NULL; // a comment may be long: it holds a command line
  size_t room = 0;
  done_t status = DONE;
  for (int n = 1; status == DONE && getline(&line, &room, file) >= 0; n++) {
    line[strcspn(line, "\r\n")] = '\0';
    if (line[0] == '\0' || line[0] == '#') continue;
    why_t cause;
    status = request_take_set(r, line, &cause);
    if (status != DONE) status = error_set(why, "%s:%d: %s", path, n, cause.text);
  }
  free(line);
  fclose(file);
  return status;
}

done_t request_take_effect(request_t *r, const char *spec, why_t *why) {
  if (strcmp(spec, "none") == 0) {
    r->no_effects = true;
    r->n_effect = 0;
    return DONE;
  }
  if (r->n_effect == FX_MAX) return error_set(why, "--effect: at most %d of them", FX_MAX);
  TRY(effect_parse(spec, &r->effect[r->n_effect], why));
  r->n_effect++;
  return DONE;
}
