// effect_spec.c - effects by name, and their numbers.
#include "vehicle/effect_spec.h"

#include "base/csv.h"
#include "base/nearest.h"
#include "base/number.h"
#include <stdio.h>
#include <string.h>

#define LIST_MAX 400
#define SPEC_MAX 512

static void list_add(char list[LIST_MAX], const char *item) {
  const size_t used = strlen(list);
  snprintf(list + used, LIST_MAX - used, "%s%s", used ? ", " : "", item);
}

done_t effect_start(fx_use_t *use, const char *name, why_t *why) {
  const fx_t *fx = fx_find(name);
  if (!fx) {
    char list[LIST_MAX] = "", shown[NUMBER_SHOWN], hint[NEAREST_HINT];
    nearest_t nearest = nearest_to(name);
    for (int i = 0; i < fx_count; i++) {
      list_add(list, fx_table[i]->name);
      nearest_try(&nearest, fx_table[i]->name);
    }
    return error_set(why, "unknown effect `%s`%s; allowed: %s", number_shown(name, shown),
                     nearest_hint(&nearest, hint), list);
  }
  *use = fx_use(fx);
  return DONE;
}

done_t effect_set_form(fx_use_t *use, const char *form, why_t *why) {
  if (!use->fx->surface) return error_set(why, "effect %s has no forms", use->fx->name);
  const curve_t *curve = curve_find(form);
  if (!curve || !(curve->surfaces & use->fx->surface)) {
    char list[LIST_MAX] = "", shown[NUMBER_SHOWN], hint[NEAREST_HINT];
    nearest_t nearest = nearest_to(form);
    for (int i = 0; i < curve_count; i++) {
      if (!(curve_table[i]->surfaces & use->fx->surface)) continue;
      list_add(list, curve_table[i]->name);
      nearest_try(&nearest, curve_table[i]->name);
    }
    return error_set(why, "effect %s: unknown form `%s`%s; allowed: %s", use->fx->name,
                     number_shown(form, shown), nearest_hint(&nearest, hint), list);
  }
  fx_use_form(use, curve);
  use->points.n = 0;
  return DONE;
}

static done_t unknown_key(const fx_use_t *use, const char *key, why_t *why) {
  char list[LIST_MAX] = "", item[100], shown[NUMBER_SHOWN], hint[NEAREST_HINT];
  int n;
  const fx_param_t *param = fx_use_params(use, &n);
  nearest_t nearest = nearest_to(key);
  for (int i = 0; i < n; i++) nearest_try(&nearest, param[i].name);
  if (use->fx->surface) nearest_try(&nearest, "form");
  if (use->fx->surface) list_add(list, "form");
  if (use->form && use->form->needs_points) list_add(list, "file");
  for (int i = 0; i < n; i++) {
    const char *const unit = fx_is_number(&param[i]) ? "" : param[i].unit;
    snprintf(item, sizeof item, "%s %g to %g%s%s", param[i].name, param[i].min, param[i].max,
             unit[0] ? " " : "", unit);
    list_add(list, item);
  }
  return error_set(why, "effect %s%s%s: unknown key `%s`%s; allowed: %s", use->fx->name,
                   use->form ? ", form " : "", use->form ? use->form->name : "", number_shown(key, shown),
                   nearest_hint(&nearest, hint), list);
}

done_t effect_set(fx_use_t *use, const char *key, double value, why_t *why) {
  int n;
  const fx_param_t *param = fx_use_params(use, &n);
  for (int i = 0; i < n; i++) {
    if (strcmp(param[i].name, key) != 0) continue;
    if (!(value >= param[i].min && value <= param[i].max))
      return error_set(why, "effect %s: %s = %g is out of range; allowed: %g to %g%s%s", use->fx->name, key,
                       value, param[i].min, param[i].max, param[i].unit[0] ? " " : "", param[i].unit);
    if (fx_is_number(&param[i]) && value != (double)(long)value)
      return error_set(why, "effect %s: %s = %g; allowed: whole numbers from %g to %g", use->fx->name, key,
                       value, param[i].min, param[i].max);
    use->p[i] = value;
    return DONE;
  }
  return unknown_key(use, key, why);
}

done_t effect_set_points(fx_use_t *use, const curve_points_t *points, why_t *why) {
  if (!use->form || !use->form->needs_points) return unknown_key(use, "file", why);
  if (points->n < 2)
    return error_set(why, "effect %s: %d points; allowed: 2 to %d", use->fx->name, points->n,
                     CURVE_POINTS_MAX);
  for (int i = 0; i < points->n; i++) {
    if (!(points->x[i] >= 0.0 && points->x[i] <= 1e3) || (i > 0 && !(points->x[i] > points->x[i - 1])))
      return error_set(why, "effect %s: point %d: distance_over_radius %g; allowed: 0 to 1000, ascending",
                       use->fx->name, i + 1, points->x[i]);
    if (!(points->ratio[i] >= 0.1 && points->ratio[i] <= 10.0))
      return error_set(why, "effect %s: point %d: ratio %g; allowed: 0.1 to 10", use->fx->name, i + 1,
                       points->ratio[i]);
  }
  use->points = *points;
  return DONE;
}

static done_t check(const fx_use_t *use, why_t *why) {
  if (use->form && use->form->needs_points && use->points.n == 0)
    return error_set(
        why, "effect %s, form %s: no points; file=FILE.csv is needed (columns distance_over_radius, ratio)",
        use->fx->name, use->form->name);
  return DONE;
}

static done_t read_points(csv_file_t *file, curve_points_t *points, why_t *why) {
  const int x = csv_find(file, "distance_over_radius"), ratio = csv_find(file, "ratio");
  if (x < 0 || ratio < 0)
    return csv_refuse(file, -1, why, "no column %s; needed: distance_over_radius, ratio",
                      x < 0 ? "distance_over_radius" : "ratio");
  points->n = 0;
  for (;;) {
    bool more;
    TRY(csv_next(file, &more, why));
    if (!more) return DONE;
    if (points->n == CURVE_POINTS_MAX)
      return csv_refuse(file, -1, why, "too many points; allowed: %d", CURVE_POINTS_MAX);
    TRY(csv_number(file, x, CSV_GAP_REFUSED, &points->x[points->n], why));
    TRY(csv_number(file, ratio, CSV_GAP_REFUSED, &points->ratio[points->n], why));
    points->n++;
  }
}

done_t effect_read_points(curve_points_t *points, const char *path, why_t *why) {
  csv_file_t *file;
  TRY(csv_open(&file, path, why));
  const done_t status = read_points(file, points, why);
  csv_close(file);
  return status;
}

static done_t set_from_text(fx_use_t *use, const char *key, const char *value, why_t *why) {
  if (strcmp(key, "file") == 0) {
    curve_points_t points = {0};
    if (use->form && use->form->needs_points) TRY(effect_read_points(&points, value, why));
    return effect_set_points(use, &points, why);
  }
  double number;
  char shown[NUMBER_SHOWN];
  if (!number_parse(value, &number))
    return error_set(why, "effect %s: %s: not a number: `%s`", use->fx->name, key,
                     number_shown(value, shown));
  return effect_set(use, key, number, why);
}

// Goes through `key=value,...`, which it changes, and sets either the form or everything else.
static done_t set_all(fx_use_t *use, char *pairs, bool form, why_t *why) {
  for (char *pair = pairs, *next; pair; pair = next) {
    next = strchr(pair, ',');
    if (next) *next++ = '\0';
    char *const value = strchr(pair, '=');
    if (!value) return error_set(why, "effect %s: `%.40s`; allowed: key=value", use->fx->name, pair);
    *value = '\0';
    const bool is_form = strcmp(pair, "form") == 0;
    if (is_form && form) TRY(effect_set_form(use, value + 1, why));
    if (!is_form && !form) TRY(set_from_text(use, pair, value + 1, why));
  }
  return DONE;
}

done_t effect_parse(const char *spec, fx_use_t *use, why_t *why) {
  char name[SPEC_MAX], pairs[SPEC_MAX];
  if (strlen(spec) >= SPEC_MAX)
    return error_set(why, "effect `%.40s...`: too long; allowed: %d bytes", spec, SPEC_MAX - 1);
  snprintf(name, sizeof name, "%s", spec);
  char *const colon = strchr(name, ':');
  if (colon) *colon = '\0';
  fx_use_t fresh;
  TRY(effect_start(&fresh, name, why));
  // The form comes first, wherever it stands, because the other keys depend on it.
  for (int pass = 0; pass < 2 && colon; pass++) {
    snprintf(pairs, sizeof pairs, "%s", colon + 1);
    TRY(set_all(&fresh, pairs, pass == 0, why));
  }
  TRY(check(&fresh, why));
  *use = fresh;
  return DONE;
}
